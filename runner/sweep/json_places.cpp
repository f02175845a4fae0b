#include "runner/sweep/json_places.hpp"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "runner/sweep/problem.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view space = " \t\r\n";
constexpr std::string_view after_scalar = " \t\r\n,]}";

/// Walks a valid JSON text once. Every step leaves the cursor behind what it has read.
class PlaceWalk {
 public:
  PlaceWalk(const std::string& text, const std::function<void(const JsonPlace&)>& visit)
      : text_(text), visit_(visit) {}

  void read_root() {
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    skip_space();
    read_value(at_, false);
  }

 private:
  char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() { at_ = std::min(text_.find_first_not_of(space, at_), text_.size()); }

  void read_value(std::size_t key, bool is_member) {
    visit_({pointer_, is_member, key, at_});
    if (now() == '{') {
      read_members();
    } else if (now() == '[') {
      read_entries();
    } else if (now() == '"') {
      skip_string();
    } else {
      at_ = std::min(text_.find_first_of(after_scalar, at_), text_.size());
    }
  }

  void read_members() {
    while (step_to_next('}')) {
      const std::size_t key = at_;
      skip_string();
      const std::size_t length = pointer_.size();
      pointer_ = child_pointer(pointer_, key_text(key, at_));
      at_ = text_.find_first_not_of(space, text_.find(':', at_) + 1);
      read_value(key, true);
      pointer_.resize(length);
    }
  }

  void read_entries() {
    for (std::size_t index = 0; step_to_next(']'); ++index) {
      const std::size_t length = pointer_.size();
      pointer_.append("/").append(std::to_string(index));
      read_value(at_, false);
      pointer_.resize(length);
    }
  }

  /// Steps over an opening bracket or a comma to the next member or entry; false, behind the
  /// bracket, if it closes here.
  bool step_to_next(char closing) {
    skip_space();
    const bool ends = now() == closing;
    ++at_;
    if (ends) return false;
    skip_space();
    if (now() != closing) return true;
    ++at_;
    return false;
  }

  void skip_string() {
    for (++at_; now() != '"' && at_ < text_.size(); ++at_) {
      if (now() == '\\') ++at_;
    }
    ++at_;
  }

  std::string key_text(std::size_t begin, std::size_t end) const {
    const std::string raw = text_.substr(begin, end - begin);
    if (raw.find('\\') == std::string::npos) return raw.substr(1, raw.size() - 2);
    return nlohmann::json::parse(raw).get<std::string>();
  }

  const std::string& text_;
  const std::function<void(const JsonPlace&)>& visit_;
  std::string pointer_;
  std::size_t at_ = 0;
};

}  // namespace

void for_each_value(const std::string& text, const std::function<void(const JsonPlace&)>& visit) {
  PlaceWalk(text, visit).read_root();
}

LineIndex::LineIndex(const std::string& text) : size_(text.size()), starts_{0} {
  if (text.starts_with(byte_order_mark)) starts_.front() = byte_order_mark.size();
  for (std::size_t at = starts_.front(); at < text.size(); ++at) {
    const bool continues = (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
    if (text[at] == '\n') starts_.push_back(at + 1);
    if (continues) continuations_.push_back(at);
  }
}

std::string LineIndex::place(std::size_t offset) const {
  offset = std::clamp(offset, starts_.front(), size_);
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const std::size_t begin = *(next - 1);
  const auto first = std::lower_bound(continuations_.begin(), continuations_.end(), begin);
  const auto last = std::lower_bound(first, continuations_.end(), offset);
  const std::size_t column = offset - begin - static_cast<std::size_t>(last - first) + 1;
  const std::string line = std::to_string(next - starts_.begin());
  return std::string(":").append(line).append(":").append(std::to_string(column));
}

}  // namespace grainsweep
