// Cells of text tables: numbers as people read them, padding that counts what a terminal shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace undex::output {

/// printf of one number.
std::string print(const char* format, double value);

/// Three or four significant digits, without exponents for the magnitudes that occur in a table; times ("us") to a
/// hundredth; whole numbers without a unit as such. NaN is "-".
std::string number(double value, const std::string& unit);

/// Difference of `mine` from `theirs`: in the unit itself for times ("us"), in percent of |theirs| for all else. NaN where
/// either is NaN, or a percentage of zero would be asked for.
double difference(double mine, double theirs, const std::string& unit);
/// The same as text, signed; percentages without a meaning beyond "very different" are cut. NaN is empty.
std::string difference_text(double difference, const std::string& unit);

/// Terminal columns of UTF-8 text.
std::size_t width(const std::string& text);
/// Text that is wider than `columns` stays as it is.
std::string padded_left(const std::string& text, std::size_t columns);
std::string padded_right(const std::string& text, std::size_t columns);

/// Lines of cells as text, columns aligned: the first `left` of them to the left, the others to the right, three blanks apart.
std::string aligned(const std::vector<std::vector<std::string>>& lines, std::size_t left);

/// A count with commas between thousands: "27,288".
std::string grouped(std::int64_t count);

/// A value [SI] with the prefix that suits it: "0.5 mm", "28.2 MPa", "150 us". Four digits; zero is "0 m".
std::string with_unit(double value, const std::string& unit);

/// A time as people say it: "12 s", "3 min 05 s", "2.4 h".
std::string duration(double seconds);

}  // namespace undex::output
