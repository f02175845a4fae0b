#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "runner/store/fields.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

const Field& field_called(std::string_view name) {
  for (const Field& field : fields()) {
    if (field.name == name) return field;
  }
  throw std::out_of_range("no field " + std::string(name));
}

TEST_CASE("every field has a name of its own, a meaning and a value") {
  std::set<std::string_view> names;
  for (const Field& field : fields()) {
    CHECK(names.insert(field.name).second);
    CHECK_FALSE(field.meaning.empty());
    CHECK(field.value != nullptr);
    CHECK((field.place != nullptr) == field.use.journal);
    CHECK((!field.use.summary || field.use.journal));
  }
}

TEST_CASE("a value stands where it is read") {
  Outcome outcome = *polyhedra_row("a", 5).outcome;
  for (const Field& field : fields()) {
    if (field.place == nullptr) continue;
    const FieldPlace place = field.place(outcome);
    CHECK(place.index() == field.value(outcome).index());
    if (auto* const* number = std::get_if<double*>(&place)) {
      **number = 0.625;
      CHECK(number_of(field, outcome) == 0.625);
    }
    if (auto* const* count = std::get_if<std::int64_t*>(&place)) {
      **count = 77;
      CHECK(number_of(field, outcome) == 77.0);
    }
  }
}

TEST_CASE("optional parts have no value until they are asked for a place") {
  for (const char* name : {"force_simple", "nematic_z"}) {
    Outcome outcome = sample_outcome("a", 0.6, 6);
    CHECK(std::holds_alternative<std::monostate>(field_called(name).value(outcome)));
    CHECK(std::isnan(number_of(field_called(name), outcome)));
    field_called(name).place(outcome);
    CHECK(outcome.result.shape_order);
    CHECK_FALSE(std::holds_alternative<std::monostate>(field_called(name).value(outcome)));
  }
}

TEST_CASE(
    "the headline coordination is that of the first tolerance, none if nothing was measured") {
  Outcome outcome = sample_outcome("a", 0.6, 6);
  CHECK(number_of(field_called("coordination"), outcome) == 6);
  CHECK(number_of(field_called("coordination_with_walls"), outcome) == 6.25);
  CHECK(number_of(field_called("contact_ratio"), outcome) == 5990.0 / 5991.0);
  CHECK(std::isnan(number_of(field_called("coordination"), Outcome())));
  CHECK(std::isnan(number_of(field_called("contact_ratio"), Outcome())));
  outcome.result.rest.isostatic_contacts = 0;  // as of a grain that nothing holds
  CHECK(std::isnan(number_of(field_called("contact_ratio"), outcome)));
}

}  // namespace
}  // namespace grainsweep
