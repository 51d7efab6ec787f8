#include "saca/lab/crash_records/fars_codes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"

namespace saca::crash_records {
namespace {

using config::Table;

constexpr std::array<std::string_view, 5> role_names{"straight", "oncoming", "crossing", "slower",
                                                     "changing_lane"};
/// Columns of which only the meaning is wanted.
constexpr std::array<std::string_view, 11> worded{"ACC_TYPE", "P_CRASH1", "P_CRASH2", "P_CRASH3",
                                                  "LGT_COND", "RELJCT2",  "VTRAFWAY", "VALIGN",
                                                  "PER_TYP",  "LOCATION", "STATE"};
constexpr std::int64_t most_code = 9'999;

int code_of(Table& row, std::string_view key) {
  return static_cast<int>(row.integer(key, 0, most_code));
}

Span read_span(Table& row, std::string_view min, std::string_view max, config::Range range) {
  const Span span{.min = row.number(min, range), .max = row.number(max, range)};
  if (span.min > span.max) {
    row.reject(max, fmt::format("want at least {}, got {}", span.min, span.max));
  }
  return span;
}

}  // namespace

std::string_view name(SpeedRole role) {
  return name_of(role, role_names);
}

Result<FarsCodes> FarsCodes::read(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema("saca.fars_codes/1");
  (void)root.text("source");
  FarsCodes codes;
  codes.read_meanings(root);
  codes.read_bodies(root);
  codes.read_speeds(root);
  if (const auto error = document.value().error()) {
    return *error;
  }
  return codes;
}

void FarsCodes::read_meanings(Table& root) {
  const auto add = [&](std::string_view column, Table& row, int code) {
    auto& table = meanings_[std::string(column)];
    if (!table.emplace(code, row.text("meaning")).second) {
      row.reject("code", fmt::format("want each code once, got {} again", code));
    }
  };
  for (const std::string_view column : worded) {
    for (Table row : root.tables(column)) {
      add(column, row, code_of(row, "code"));
    }
  }
  for (Table row : root.tables("VSURCOND")) {
    const int code = code_of(row, "code");
    add("VSURCOND", row, code);
    grips_[code] = read_span(row, "grip_min", "grip_max", {0.2, 1.0});
  }
}

void FarsCodes::read_bodies(Table& root) {
  for (Table row : root.tables("BODY_TYP")) {
    const std::string kind = row.text("kind");
    Body body{.first = code_of(row, "code"),
              .last = code_of(row, "last"),
              .kind = world::actor_kind_from(kind),
              .meaning = row.text("meaning")};
    if (!body.kind && kind != "none") {
      row.reject("kind", "want car, van, truck, motorcycle or none, got \"" + kind + "\"");
    }
    bodies_.push_back(std::move(body));
  }
}

void FarsCodes::read_speeds(Table& root) {
  for (Table row : root.tables("speed_over_limit")) {
    const std::string role = row.text("role");
    const auto known = value_from<SpeedRole>(role, role_names);
    if (!known) {
      row.reject("role", "want straight, oncoming, crossing, slower or changing_lane, got \"" +
                             role + "\"");
    }
    (void)row.integer("n", 1, 1'000'000'000);
    speeds_[known.value_or(SpeedRole::straight)] = read_span(row, "min", "max", {0.01, 5.0});
  }
  if (speeds_.size() != role_names.size()) {
    root.reject("speed_over_limit", fmt::format("want one entry a role, {}, got {}",
                                                role_names.size(), speeds_.size()));
  }
}

Result<FarsCodes> FarsCodes::load(const std::filesystem::path& file) {
  const auto text = read_file(file);
  return text.has_value() ? read(text.value(), file.string()) : Result<FarsCodes>(text.error());
}

std::string FarsCodes::meaning(std::string_view column, const Code& code) const {
  if (!code) {
    return "not known";
  }
  if (column == "BODY_TYP") {
    for (const Body& body : bodies_) {
      if (*code >= body.first && *code <= body.last) {
        return body.meaning;
      }
    }
  }
  const auto table = meanings_.find(column);
  if (table != meanings_.end()) {
    if (const auto found = table->second.find(*code); found != table->second.end()) {
      return found->second;
    }
  }
  return fmt::format("code {}", *code);
}

std::optional<world::ActorKind> FarsCodes::kind_of_body(const Code& body) const {
  for (const Body& one : bodies_) {
    if (body && *body >= one.first && *body <= one.last) {
      return one.kind;
    }
  }
  return std::nullopt;
}

std::optional<Span> FarsCodes::grip(const Code& surface) const {
  const auto found = surface ? grips_.find(*surface) : grips_.end();
  return found == grips_.end() ? std::nullopt : std::optional(found->second);
}

Span FarsCodes::speed_over_limit(SpeedRole role) const {
  return speeds_.at(role);
}

}  // namespace saca::crash_records
