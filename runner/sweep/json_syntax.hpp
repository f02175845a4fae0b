// What is wrong with a text that is not JSON, in words that say what to change.
#pragma once

#include <cstddef>
#include <string>

namespace grainsweep {

struct SyntaxError {
  std::size_t offset = 0;  ///< byte in the text
  std::string message;
};

/// Where a parser gave up, as offsets of bytes.
struct SyntaxStop {
  std::size_t at = 0;         ///< the last byte it has read
  std::size_t token_end = 0;  ///< behind the last token that it understood
};

/// The first error of `text`, from where the parser stopped and what it said.
SyntaxError syntax_error(const std::string& text, const SyntaxStop& stop,
                         const std::string& complaint);

/// Whether a number may go on with the last byte before `end`.
bool ends_number(const std::string& text, std::size_t end);

}  // namespace grainsweep
