#include "runner/sweep/json_text.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <unordered_map>
#include <utility>

#include "runner/sweep/json_syntax.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

/// Hands a text to the parser and lets others know how far it has read.
struct Cursor {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  Cursor& operator++() {
    *reached = ++at;
    return *this;
  }
  bool operator==(const Cursor& other) const { return at == other.at; }
};

/// Builds the values as the parser finds them, and notes the place of each.
///
/// An event comes when the parser has read a token and no more, except that the end of a number is
/// known only from the character after it. Between two tokens there are only blanks, commas and
/// colons: what follows them is the start of the next.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& text, std::string file)
      : text_(text),
        file_(std::move(file)),
        end_(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0) {}

  JsonReading read() {
    const Cursor begin{text_.data(), &reached_}, end{text_.data() + text_.size(), &reached_};
    Json::sax_parse(begin, end, this);
    if (reading_.errors.empty()) note_duplicates();
    return std::move(reading_);
  }

  bool null() override { return take(nullptr); }
  bool boolean(bool value) override { return take(value); }
  bool number_integer(number_integer_t value) override { return take(value); }
  bool number_unsigned(number_unsigned_t value) override { return take(value); }
  bool number_float(number_float_t value, const string_t&) override { return take(value); }
  bool string(string_t& value) override { return take(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // comes from binary formats only
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    key_ = next_token();
    end_ = reached();
    const auto [first, is_new] = open_.back().keys.emplace(name, key_);
    open_.back().value->get_ref<Json::object_t&>().emplace_back(std::move(name), nullptr);
    if (!is_new) duplicates_.push_back({pointer_here(), key_, first->second});
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const SyntaxError found =
        syntax_error(text_, {std::max<std::size_t>(position, 1) - 1, end_}, error.what());
    refuse(found.offset, found.message);
    return false;
  }

 private:
  /// A list or an object whose end is still to come.
  struct Open {
    Json* value;
    std::unordered_map<std::string, std::size_t> keys;  ///< offset of each, of an object
  };

  struct Duplicate {
    std::string pointer;
    std::size_t key, first;  ///< offsets of both keys
  };

  std::size_t reached() const { return static_cast<std::size_t>(reached_ - text_.data()); }
  std::size_t next_token() const { return text_.find_first_not_of(" \t\r\n,:", end_); }

  bool take(Json value) {
    add(std::move(value));
    return true;
  }

  Json& add(Json value) {
    const std::size_t start = next_token();
    const bool is_member = !open_.empty() && open_.back().value->is_object();
    reading_.places.push_back(
        {static_cast<std::uint32_t>(is_member ? key_ : start), static_cast<std::uint32_t>(start)});
    end_ = reached();
    if (value.is_number() && !ends_number(text_, end_)) --end_;
    if (open_.empty()) return reading_.value = std::move(value);
    Json& parent = *open_.back().value;
    if (!is_member) parent.push_back(nullptr);
    return parent.back() = std::move(value);
  }

  bool open(Json container) {
    open_.push_back({&add(std::move(container)), {}});
    if (open_.size() <= deepest_json) return true;
    refuse(end_ - 1, "is nested deeper than " + std::to_string(deepest_json) + " levels");
    return false;
  }

  bool close() {
    open_.pop_back();
    end_ = reached();
    return true;
  }

  /// Pointer of the member that was read last.
  std::string pointer_here() const {
    std::string pointer;
    for (const Open& container : open_) {
      const Json& value = *container.value;
      pointer = child_pointer(pointer, value.is_array()
                                           ? std::to_string(value.size() - 1)
                                           : value.get_ref<const Json::object_t&>().back().first);
    }
    return pointer;
  }

  void refuse(std::size_t offset, const std::string& message) {
    reading_.errors = {{"", message, Anchor::value, file_ + LineIndex(text_).place(offset)}};
  }

  void note_duplicates() {
    if (duplicates_.empty()) return;
    const LineIndex lines(text_);
    for (const Duplicate& duplicate : duplicates_) {
      reading_.errors.push_back({duplicate.pointer,
                                 "the same key is already written at " +
                                     lines.place(duplicate.first).substr(1) + "; keep one of them",
                                 Anchor::key, file_ + lines.place(duplicate.key)});
    }
  }

  const std::string& text_;
  const std::string file_;
  const char* reached_ = text_.data();  ///< behind the last character that the parser has read
  std::size_t end_ = 0;                 ///< offset behind the last token
  std::size_t key_ = 0;                 ///< offset of the last key
  std::vector<Open> open_;              ///< from the outside in
  std::vector<Duplicate> duplicates_;
  JsonReading reading_;
};

/// The places of some pointers; null where there is nothing.
using Wanted = std::unordered_map<std::string, const JsonPlace*>;

std::string parent_of(const std::string& pointer) { return pointer.substr(0, pointer.rfind('/')); }

/// The pointers of the diagnostics and all that contains them.
Wanted wanted_pointers(const Diagnostics& diagnostics) {
  Wanted wanted = {{"", nullptr}};
  for (const Diagnostic& diagnostic : diagnostics) {
    std::string pointer = diagnostic.pointer;
    while (wanted.emplace(pointer, nullptr).second) pointer = parent_of(pointer);
  }
  return wanted;
}

/// Finds what is wanted of `value`, written at `pointer`. `place` is its place at first, and at
/// last the place after it and all its parts.
void look_up(const Json& value, const std::string& pointer, const JsonPlace*& place,
             Wanted& wanted) {
  const auto entry = wanted.find(pointer);
  if (entry != wanted.end()) entry->second = place;
  ++place;
  if (!value.is_structured()) return;
  for (const auto& [key, part] : value.items()) {
    look_up(part, child_pointer(pointer, key), place, wanted);
  }
}

std::size_t offset_of(const Diagnostic& diagnostic, const Wanted& wanted) {
  std::string pointer = diagnostic.pointer;
  while (wanted.at(pointer) == nullptr) pointer = parent_of(pointer);
  const JsonPlace& place = *wanted.at(pointer);
  return diagnostic.anchor == Anchor::key ? place.key : place.value;
}

}  // namespace

JsonReading parse_strictly(const std::string& text, const std::string& file) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    JsonReading reading;
    const char* const message = "is UTF-16 text; save the file as UTF-8";
    reading.errors = {{"", message, Anchor::value, file + ":1:1"}};
    return reading;
  }
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {  // ends it for parsers
    JsonReading reading;
    reading.errors = {{"", "a byte is zero: this is no text, or the file is damaged", Anchor::value,
                       file + LineIndex(text).place(zero)}};
    return reading;
  }
  return Builder(text, file).read();
}

void locate(const JsonReading& json, const std::string& text, const std::string& file,
            Diagnostics& diagnostics) {
  if (diagnostics.empty()) return;
  Wanted wanted = wanted_pointers(diagnostics);
  const JsonPlace* first = json.places.data();
  look_up(json.value, "", first, wanted);
  std::vector<std::pair<std::size_t, std::size_t>> order;  // offset and index
  for (std::size_t i = 0; i < diagnostics.size(); ++i) {
    order.emplace_back(offset_of(diagnostics[i], wanted), i);
  }
  std::sort(order.begin(), order.end());

  const LineIndex lines(text);
  Diagnostics located;
  std::set<std::string> said;
  for (const auto& [offset, index] : order) {
    Diagnostic& diagnostic = diagnostics[index];
    if (diagnostic.place.empty()) {
      diagnostic.place = file + lines.place(offset);
    } else {
      diagnostic.pointer.clear();
    }
    if (said.insert(to_string(diagnostic)).second) located.push_back(std::move(diagnostic));
  }
  diagnostics = std::move(located);
}

}  // namespace grainsweep
