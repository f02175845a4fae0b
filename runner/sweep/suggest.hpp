// "Did you mean": the known word nearest to an unknown one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"

namespace grainsweep {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or the only one that begins with it; "" if there is none: more
/// than a third of the word is wrong.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// `text`, cut with "..." if it is too long for a message; never within a character of UTF-8.
std::string shortened(std::string_view text);

/// "a, b, c".
std::string comma_list(const std::vector<std::string>& words);

/// The same of the words without a dot.
std::string short_list(const std::vector<std::string>& words);

/// "unknown key "widht"; did you mean "width"?", or the keys known there (without dotted ones) if
/// none is near.
std::string unknown_key(std::string_view key, const std::vector<std::string>& known);

/// Notes each member of `object`, which stands at `pointer`, that is not known there.
void refuse_unknown_keys(const Json& object, const std::string& pointer,
                         const std::vector<std::string>& known, Diagnostics& diagnostics);

}  // namespace grainsweep
