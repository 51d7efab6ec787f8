#include "saca/thinking/memory/case_row.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <utility>

#include "saca/base/formats/json_text.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/scene_json.h"

namespace saca::memory {
namespace {

/// Places in `case_columns`.
enum Place : std::size_t {
  policy_at,
  target_speed_at,
  best_policy_at,
  harm_at,
  best_harm_at,
  collision_loss_at,
  review_at,
  source_at,
  scene_at,
  strength_at,
  details_at,
};
static_assert(details_at + 1 == case_columns.size());

/// Reads the cells of a row; the first thing wrong is kept.
class RowReader {
 public:
  RowReader(match::CaseId id, const Cells& cells, const std::string& where)
      : id_(id), cells_(cells), where_(where) {}

  /// @return  in [0, 7]
  manoeuvre::PolicyId policy(Place place) {
    const auto* const number = std::get_if<std::int64_t>(&cells_.at(place));
    if (number == nullptr || *number < 0 ||
        *number >= static_cast<std::int64_t>(manoeuvre::num_policies)) {
      reject(place, "want an integer from 0 to 7, got " + text_of(cells_.at(place)));
      return manoeuvre::PolicyId::aeb;
    }
    return manoeuvre::all_policies.at(static_cast<std::size_t>(*number));
  }

  double amount(Place place) {
    const Cell& cell = cells_.at(place);
    const auto* const whole = std::get_if<std::int64_t>(&cell);
    const auto* const real = std::get_if<double>(&cell);
    const double number = whole != nullptr  ? static_cast<double>(*whole)
                          : real != nullptr ? *real
                                            : -1.0;
    if (!std::isfinite(number) || number < 0.0) {
      const bool nothing = std::holds_alternative<std::monostate>(cell);
      reject(place, "want a finite number >= 0, got " + (nothing ? "nothing" : text_of(cell)));
    }
    return number;
  }

  std::optional<double> optional_amount(Place place) {
    return std::holds_alternative<std::monostate>(cells_.at(place)) ? std::nullopt
                                                                    : std::optional(amount(place));
  }

  std::string text(Place place) {
    const auto* const found = std::get_if<std::string>(&cells_.at(place));
    if (found == nullptr) {
      reject(place, "want text");
      return "";
    }
    return *found;
  }

  world::Scene scene(Place place) {
    const auto parsed = formats::parse_json(text(place));
    if (!parsed.has_value()) {
      reject(place, parsed.error().message);
      return {};
    }
    Result<world::Scene> scene = scene_from_json(parsed.value());
    if (!scene.has_value()) {
      reject(place, scene.error().message);
      return {};
    }
    return std::move(scene).value();
  }

  /// What version 2 did not know, and the rules of a whole case.
  void read_details(Case& one) {
    const auto parsed = formats::parse_json(text(details_at));
    if (!parsed.has_value()) {
      reject(details_at, parsed.error().message);
    } else if (const auto problem = memory::read_details(parsed.value(), one)) {
      reject(details_at, problem->message);
    }
    if (const auto broken = broken_rule(one)) {
      reject(broken->key, broken->why);
    }
  }

  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  void reject(Place place, const std::string& why) { reject(case_columns.at(place).name, why); }
  void reject(const std::string& key, const std::string& why) {
    if (!problem_) {
      problem_ = Error{Error::Code::malformed,
                       fmt::format("{}: table cases, id {}: {}: {}", where_, id_, key, why)};
    }
  }

  match::CaseId id_;
  const Cells& cells_;
  const std::string& where_;
  std::optional<Error> problem_;
};

Cell cell_of(const std::optional<double>& number) {
  return number ? Cell(*number) : Cell();
}

}  // namespace

std::string text_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
          return "";
        } else {
          return fmt::format("{}", value);
        }
      },
      cell);
}

Cells cells_of(const Case& one) {
  return {static_cast<std::int64_t>(one.plan.policy),
          cell_of(one.plan.target_speed),
          static_cast<std::int64_t>(one.best),
          one.harm,
          one.best_harm,
          one.collision_loss,
          one.review,
          one.source,
          to_json(one.scene).dump(),
          cell_of(one.plan.strength),
          details_json(one).dump()};
}

Result<Case> case_from_cells(match::CaseId id, const Cells& cells, const std::string& where) {
  RowReader row(id, cells, where);
  Case one{.id = id,
           .scene = row.scene(scene_at),
           .plan = {row.policy(policy_at), row.optional_amount(target_speed_at),
                    row.optional_amount(strength_at)},
           .best = row.policy(best_policy_at),
           .harm = row.amount(harm_at),
           .best_harm = row.amount(best_harm_at),
           .collision_loss = row.amount(collision_loss_at),
           .review = row.text(review_at),
           .source = row.text(source_at)};
  row.read_details(one);
  if (row.problem()) {
    return *row.problem();
  }
  return one;
}

std::optional<Error> wrong_version(std::int64_t version, const std::string& where) {
  if (version >= 1 && version <= table_version) {
    return std::nullopt;
  }
  return Error{Error::Code::malformed,
               fmt::format("{}: want version {} of a memory bank or an older one, got version {}",
                           where, table_version, version)};
}

Error no_such_bank(const std::string& where) {
  return {Error::Code::unreadable, where + ": there is no such memory bank"};
}

std::string column_names() {
  std::string names = "id";
  for (const Column& column : case_columns) {
    names += std::string(", ") + column.name;
  }
  return names;
}

std::string parameters(char mark) {
  std::string text;
  for (std::size_t i = 0; i < case_columns.size(); ++i) {
    text += fmt::format("{}{}{}", i == 0 ? "" : ", ", mark, i + 2);
  }
  return text;
}

std::string assignments(char mark) {
  std::string text;
  for (std::size_t i = 0; i < case_columns.size(); ++i) {
    text += fmt::format("{}{} = {}{}", i == 0 ? "" : ", ", case_columns.at(i).name, mark, i + 2);
  }
  return text;
}

std::string column_definition(const Column& column, const std::array<const char*, 3>& types) {
  return fmt::format(
      "{} {}{}{}", column.name, types.at(static_cast<std::size_t>(column.kind)),
      column.may_be_null ? "" : " NOT NULL",
      column.of_older_rows == nullptr ? "" : fmt::format(" DEFAULT {}", column.of_older_rows));
}

}  // namespace saca::memory
