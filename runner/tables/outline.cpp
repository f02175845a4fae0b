#include "runner/tables/outline.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include <nlohmann/json.hpp>

namespace grainsweep {
namespace {

using nlohmann::json;

/// Follows the text member by member and picks /sweep_file, /sweep/name and /sweep/jobs/*/id.
class OutlineReader final : public json::json_sax_t {
 public:
  Outline take() {
    if (!has_name_ || !has_file_) {
      throw json::out_of_range::create(403, "no sweep in it", nullptr);
    }
    return std::move(outline_);
  }

  bool string(std::string& value) override {
    if (is_at({"sweep_file"})) {
      outline_.sweep_file = std::move(value);
      has_file_ = true;
    } else if (is_at({"sweep", "name"})) {
      outline_.name = std::move(value);
      has_name_ = true;
    } else if (is_at({"sweep", "jobs", "", "id"})) {
      outline_.jobs.push_back(std::move(value));
    }
    return true;
  }
  bool key(std::string& name) override {
    path_.back() = std::move(name);
    return true;
  }
  bool start_object(std::size_t) override { return go_down(); }
  bool start_array(std::size_t) override { return go_down(); }
  bool end_object() override { return go_up(); }
  bool end_array() override { return go_up(); }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool parse_error(std::size_t at, const std::string& last, const json::exception& error) override {
    throw json::parse_error::create(101, at, std::string(error.what()) + " at " + last, nullptr);
  }

 private:
  bool go_down() {
    path_.emplace_back();
    return true;
  }
  bool go_up() {
    path_.pop_back();
    return true;
  }
  bool is_at(std::initializer_list<std::string_view> path) const {
    return std::equal(path.begin(), path.end(), path_.begin(), path_.end());
  }

  Outline outline_;
  std::vector<std::string> path_;  ///< keys from the top down; empty for elements of an array
  bool has_name_ = false, has_file_ = false;
};

}  // namespace

Outline outline_from_text(std::string_view text) {
  OutlineReader reader;
  json::sax_parse(text, &reader);
  return reader.take();
}

}  // namespace grainsweep
