#include "saca/thinking/language_model/number_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "saca/thinking/language_model/words.h"

namespace saca::language_model {
namespace {

bool agree(const QuotedNumber& said, const QuotedNumber& known) {
  const bool same_unit = said.unit.empty() || known.unit.empty() || said.unit == known.unit;
  constexpr double rounding = 1e-9;
  constexpr double coarsest = 0.1;  // of the number: 1 is not a rounded 0.9
  const bool may_be_rounded = said.resolution <= coarsest * said.value;
  const double off = may_be_rounded ? 0.5 * said.resolution : 0.0;
  const bool same_place = said.where.empty() || said.where == known.where;
  const bool same_kind = said.of_what.empty() || said.of_what == known.of_what ||
                         (said.of_what == "edge" && known.of_what.ends_with(" edge"));
  return same_unit && same_place && same_kind &&
         std::abs(said.value - known.value) <= off + rounding;
}

/// "16 / 14 = 1.14": to the decimals that are quoted.
bool is_quotient(const std::vector<QuotedNumber>& numbers, std::size_t i) {
  return i >= 2 && numbers[i].after_equals && numbers[i - 1].value != 0.0 &&
         std::abs(numbers[i - 2].value / numbers[i - 1].value - numbers[i].value) <=
             0.5 * numbers[i].resolution + 1e-9;
}

}  // namespace

bool is_of_an_edge(std::string_view low) {
  return has_any(low, std::array<std::string_view, 4>{"edge", "trees", "barrier", "kerb"});
}

std::vector<QuotedNumber> numbers_said(std::string_view text, int side) {
  const bool of_an_edge = is_of_an_edge(lowered(text));
  std::vector<QuotedNumber> said = quoted_numbers(text);
  for (QuotedNumber& one : said) {
    if (one.where == "away") {
      one.where.clear();
      one.of_what = of_an_edge && !one.of_what.ends_with("edge") ? "edge" : one.of_what;
    }
    if (one.of_what == "edge" && side != 0) {
      one.of_what = side > 0 ? "left edge" : "right edge";
    }
  }
  return said;
}

std::optional<QuotedNumber> unfounded(const std::vector<QuotedNumber>& said,
                                      std::string_view lines) {
  std::vector<QuotedNumber> known = quoted_numbers(lines);
  if (has_phrase(lines, "no harm")) {
    // Nothing but a number without a unit.
    known.push_back({.text = "0", .unit = "of harm", .where = {}, .of_what = "harm"});
  }
  for (std::size_t i = 0; i < said.size(); ++i) {
    const bool stands = std::any_of(known.begin(), known.end(),
                                    [&](const QuotedNumber& each) { return agree(said[i], each); });
    if (!stands && !is_quotient(said, i)) {
      return said[i];
    }
  }
  return std::nullopt;
}

}  // namespace saca::language_model
