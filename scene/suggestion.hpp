// The nearest word: "did you mean".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace undex::scene {

/// The candidate that a misspelt word most likely means, or empty where none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean 'x'?" where something is near, else "; known: a, b, c" (empty where nothing is known).
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c".
/// The few of the candidates that are the most like the word.
std::vector<std::string> nearest_few(std::string_view word, std::vector<std::string> candidates);
std::string listed(const std::vector<std::string>& words);

}  // namespace undex::scene
