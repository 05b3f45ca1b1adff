// Large pages for arrays that pairs read all over: fewer addresses to translate.
#pragma once

#include <cstddef>

namespace undex::sph {

/// Size and alignment of a large page [byte].
inline constexpr std::size_t large_page = std::size_t(1) << 21;

/// Asks for large pages under an array that nobody has touched yet; a small one, or a system without them, stays as it is.
void ask_for_large_pages(void* data, std::size_t bytes);

}  // namespace undex::sph
