// Numbers, durations and words as people and shells read them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace grainsweep {

/// `text` filled up with blanks to `width` characters (not bytes), on its left or right.
std::string pad_left(const std::string& text, std::size_t width);
std::string pad_right(const std::string& text, std::size_t width);

/// The words of a text in lines of at most `width` characters, where they have room.
std::string filled_lines(const std::string& text, std::size_t width);

/// The text with each `from`, which is not empty, replaced.
std::string replaced(std::string text, std::string_view from, std::string_view to);

/// "1 packing", "12 packings".
std::string counted(std::size_t count, const std::string& noun);

/// "0.6123" with so many decimals; "-" for NaN.
std::string fixed(double value, int decimals);

/// The same of what may be any size, as chi2 is: from 10,000 on "2.4e+07".
std::string fixed_or_power(double value, int decimals);

/// "0.6390 ± 0.0012", "0.6390" if there is no error; "-" without a value. An error too small for
/// the decimals gets up to four more.
std::string with_error(double value, double error, int decimals);

/// "26 kB", "1.3 MB": kB below 1 MB, at least one.
std::string size_text(std::size_t bytes);

/// "8.7e-05"; "-" for NaN.
std::string power_text(double value);

/// A word as a shell takes it: in quotes where it has to be, so that printed commands can be
/// pasted.
std::string shell_word(const std::string& word);

/// The same for a path; one that begins like an option gets "./" in front: "./-x.json".
std::string shell_path(const std::string& path);

/// "41.2 s", "12 min 5 s", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace grainsweep
