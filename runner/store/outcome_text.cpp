#include "runner/store/outcome_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "runner/store/fields.hpp"

namespace grainsweep {
namespace {

using nlohmann::ordered_json;

/// A value that is no finite number becomes a text.
ordered_json number_json(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}

std::optional<double> number_from(const std::string& text) {
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  return std::nullopt;
}

std::optional<PackingStatus> status_from(const std::string& name) {
  for (const auto status : {PackingStatus::settled, PackingStatus::not_settled,
                            PackingStatus::cancelled, PackingStatus::failed}) {
    if (name == name_of(status)) return status;
  }
  return std::nullopt;
}

struct ToJson {
  ordered_json operator()(std::monostate /*none*/) const { return {}; }
  ordered_json operator()(double value) const { return number_json(value); }
  ordered_json operator()(PackingStatus status) const { return name_of(status); }
  ordered_json operator()(const std::vector<Coordination>& list) const {
    ordered_json all = ordered_json::array();
    for (const Coordination& at : list) {
      all.push_back(number_json(at.gap_tolerance));
      all.push_back(number_json(at.between_grains));
      all.push_back(number_json(at.with_walls));
    }
    return all;
  }
  template <class Plain>
  ordered_json operator()(const Plain& value) const {
    return value;
  }
};

const Field* field_called(std::string_view name) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Field*> map;
    for (const Field& field : fields()) {
      if (field.use.journal) map[field.name] = &field;
    }
    return map;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

/// How many of its fields an outcome has.
std::size_t count_fields(const Outcome& outcome, Detail detail) {
  const auto counts = [&](const Field& field) {
    const bool is_read = detail == Detail::whole || field.use.summary;
    return field.use.journal && is_read &&
           !std::holds_alternative<std::monostate>(field.value(outcome));
  };
  return static_cast<std::size_t>(std::count_if(fields().begin(), fields().end(), counts));
}

/// Puts the values of a JSON object where they belong, one after the other; each function returns
/// false, which ends the reading, at a value that does not belong anywhere.
class OutcomeReader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit OutcomeReader(Detail detail) : detail_(detail) {}

  /// Nothing unless every field was read.
  Boxed<Outcome> take() {
    if (seen_ != count_fields(*outcome_, detail_)) return std::nullopt;
    return std::move(outcome_);
  }

  bool key(std::string& name) override {
    const Field* field = field_called(name);
    const bool is_read = field != nullptr && (detail_ == Detail::whole || field->use.summary);
    if (is_read) place_ = field->place(*outcome_), ++seen_;
    return is_read;
  }
  bool boolean(bool value) override { return set(value); }
  bool number_integer(std::int64_t value) override { return set_number(value); }
  bool number_unsigned(std::uint64_t value) override { return set_number(value); }
  bool number_float(double value, const std::string& /*text*/) override { return set_real(value); }
  bool string(std::string& text) override {
    if (std::holds_alternative<std::string*>(place_)) return set(std::move(text));
    if (std::holds_alternative<PackingStatus*>(place_)) {
      const auto status = status_from(text);
      return status && set(*status);
    }
    const auto number = number_from(text);
    return number && set_real(*number);
  }
  bool start_array(std::size_t /*size*/) override {
    item_ = 0;
    return std::holds_alternative<std::vector<Coordination>*>(place_);
  }
  bool end_array() override { return item_ == 0; }
  bool start_object(std::size_t /*size*/) override { return true; }
  bool end_object() override { return true; }
  bool null() override { return false; }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return false; }
  bool parse_error(std::size_t /*at*/, const std::string& /*last*/,
                   const nlohmann::json::exception& /*error*/) override {
    return false;
  }

 private:
  template <class Value>
  bool set(Value&& value) {
    auto* const* const place = std::get_if<std::remove_cvref_t<Value>*>(&place_);
    if (place != nullptr) **place = std::forward<Value>(value);
    return place != nullptr;
  }
  template <class Whole>
  bool set_number(Whole value) {
    if (std::holds_alternative<std::int64_t*>(place_)) return set(static_cast<std::int64_t>(value));
    if (std::holds_alternative<std::uint64_t*>(place_)) {
      return set(static_cast<std::uint64_t>(value));
    }
    return set_real(static_cast<double>(value));
  }
  bool set_real(double value) {
    auto* const* const list = std::get_if<std::vector<Coordination>*>(&place_);
    if (list == nullptr) return set(value);
    if (item_ == 0) (*list)->emplace_back();
    Coordination& at = (*list)->back();
    (item_ == 0 ? at.gap_tolerance : item_ == 1 ? at.between_grains : at.with_walls) = value;
    item_ = (item_ + 1) % 3;
    return true;
  }

  Detail detail_;
  Boxed<Outcome> outcome_{Outcome()};
  FieldPlace place_;
  std::size_t seen_ = 0;
  int item_ = 0;  ///< of the three of a coordination
};

}  // namespace

std::string outcome_text(const Outcome& outcome) {
  ordered_json all;
  for (const bool summary : {true, false}) {
    for (const Field& field : fields()) {
      if (!field.use.journal || field.use.summary != summary) continue;
      const FieldValue value = field.value(outcome);
      if (std::holds_alternative<std::monostate>(value)) continue;
      all[std::string(field.name)] = std::visit(ToJson(), value);
    }
  }
  return all.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Boxed<Outcome> outcome_from_text(std::string_view text, Detail detail) {
  OutcomeReader reader(detail);
  const bool is_whole = nlohmann::json::sax_parse(text, &reader);
  if (!is_whole && detail == Detail::whole) return std::nullopt;
  return reader.take();
}

}  // namespace grainsweep
