#include "saca/lab/eval/regulation_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"

namespace saca::eval {
namespace {

using config::Table;

constexpr std::array<std::string_view, 4> target_names{"car", "adult", "child", "bicycle"};

/// No car on a road is wider [m]: ISO 612 vehicles have up to 2.55 m.
constexpr double widest = 2.55;

template <class Word>
Word word_of(Table& table, std::string_view key, std::span<const std::string_view> words) {
  const std::string got = table.text(key);
  const auto found = std::find(words.begin(), words.end(), got);
  if (found == words.end()) {
    std::string wanted;
    for (const std::string_view word : words) {
      wanted += (wanted.empty() ? "" : ", ") + std::string(word);
    }
    table.reject(key, fmt::format("want one of {}; got \"{}\"", wanted, got));
    return Word{};
  }
  return static_cast<Word>(found - words.begin());
}

double kmh_in(Table& table, std::string_view key, double least = 0.0) {
  return from_kmh(table.number(key, {least, 300.0}));
}

std::vector<double> list_in(Table& table, std::string_view key, config::Range range,
                            double (*to_si)(double),
                            std::optional<std::size_t> size = std::nullopt) {
  std::vector<double> values = table.numbers(key, range, size);
  if (values.empty()) {
    table.reject(key, "want at least one value, got none");
  }
  std::transform(values.begin(), values.end(), values.begin(), to_si);
  return values;
}

double as_it_is(double value) {
  return value;
}

TestTarget read_target(Table table) {
  TestTarget target;
  target.name =
      target_names[static_cast<std::size_t>(word_of<std::uint8_t>(table, "name", target_names))];
  target.length = table.number("length_m", {0.1, 10.0});
  target.width = table.number("width_m", {0.1, 3.0});
  target.mass = table.number("mass_kg", {1.0, 1e4});
  target.source = table.text("source");
  return target;
}

TestTarget target_in(Table& table, const std::vector<TestTarget>& targets) {
  const std::string wanted = table.text("target");
  for (const TestTarget& target : targets) {
    if (target.name == wanted) {
      return target;
    }
  }
  table.reject("target", fmt::format("want one of the [[targets]]; got \"{}\"", wanted));
  return {.name = "adult", .length = 0.5, .width = 0.5, .mass = 75.0, .source = {}};
}

void read_crossing(Table& table, RegulationRow& row) {
  row.target_speed = kmh_in(table, "target_speed_kmh", 0.1);
  row.start_offset = table.optional_number("start_offset_m", {2.0, 50.0});
  if (row.start_offset) {
    row.speed_within = table.number("speed_within_m", {0.01, 10.0});
    if (crossing_time(row, widest) > row.time_to_collision) {
      table.reject(
          "start_offset_m",
          fmt::format("want who crosses to be there within the {} s to collision, got {:.2f} s",
                      row.time_to_collision, crossing_time(row, widest)));
    }
  }
  if (auto parked = table.optional_table("parked")) {
    row.parked = ParkedCars{.between = parked->number("between_m", {0.0, 20.0}),
                            .before_target = parked->number("before_target_m", {0.0, 20.0}),
                            .beside_subject = parked->number("beside_subject_m", {0.0, 20.0})};
  }
}

/// Who crosses, stands or walks, and where it meets the ego.
void read_person(Table& table, RegulationRow& row, const std::vector<TestTarget>& targets) {
  constexpr std::array<std::string_view, 2> sides{"left", "right"};
  row.target = target_in(table, targets);
  row.from_right = word_of<std::uint8_t>(table, "from", sides) != 0;
  row.overlap = 0.01 * table.number("overlap_percent", {0.0, 100.0});
  if (row.kind == TestKind::crossing) {
    read_crossing(table, row);
  } else if (row.kind == TestKind::walking_along) {
    row.target_speed = kmh_in(table, "target_speed_kmh", 0.1);
  }
}

void read_kind(Table& table, RegulationRow& row, const std::vector<TestTarget>& targets) {
  if (row.kind == TestKind::braking_lead) {
    row.headways = list_in(table, "headways_m", {1.0, 200.0}, as_it_is);
    row.decelerations = list_in(table, "decelerations_g", {0.01, 1.0}, from_g);
    row.following = table.number("following_s", {0.0, 30.0});
    return;
  }
  row.time_to_collision = table.number("time_to_collision_s", {0.5, 30.0});
  switch (row.kind) {
    case TestKind::slower_lead:
      row.lead_speed = kmh_in(table, "lead_speed_kmh", 0.1);
      break;
    case TestKind::crossing:
    case TestKind::standing:
    case TestKind::walking_along:
      read_person(table, row, targets);
      break;
    case TestKind::pass_between:
      row.gap = table.number("gap_m", {widest, 20.0});
      break;
    case TestKind::curve:
      row.target = target_in(table, targets);
      row.outer_radius = table.number("outer_radius_m", {10.0, 1000.0});
      break;
    case TestKind::stopped_lead:
    case TestKind::braking_lead:
    case TestKind::steel_plate:
      break;
  }
}

RegulationRow read_row(Table table, const std::vector<TestTarget>& targets) {
  RegulationRow row;
  row.name = table.plain_name("name");
  row.title = table.text("title");
  row.kind = word_of<TestKind>(table, "kind", test_kind_names);
  row.paragraph = table.text("paragraph");
  if (row.paragraph.empty()) {
    table.reject("paragraph", "want the paragraph that asks for this, got nothing");
  }
  row.speeds = list_in(table, "speeds_kmh", {1.0, 200.0}, from_kmh);
  row.manual_braking = table.flag("manual_braking", false);
  read_kind(table, row, targets);
  const double slowest = *std::min_element(row.speeds.begin(), row.speeds.end());
  const double ahead =
      std::max(row.lead_speed, row.kind == TestKind::walking_along ? row.target_speed : 0.0);
  if (slowest <= ahead) {
    table.reject("speeds_kmh",
                 fmt::format("want more than the {:.1f} km/h of who is ahead, got {:.1f}",
                             to_kmh(ahead), to_kmh(slowest)));
  }
  row.limit = word_of<LimitKind>(table, "limit", limit_kind_names);
  if (row.limit == LimitKind::impact_speed) {
    row.impact_speeds =
        list_in(table, "impact_speeds_kmh", {0.0, 200.0}, from_kmh, row.speeds.size());
  } else if (row.limit == LimitKind::deceleration) {
    row.peak_deceleration = from_g(table.number("peak_deceleration_g", {0.001, 2.0}));
  }
  return row;
}

Regulation read_whole(Table root) {
  Regulation regulation;
  regulation.name = root.plain_name("name");
  regulation.title = root.text("title");
  regulation.source = root.text("source");
  for (Table table : root.tables("surfaces")) {
    regulation.surfaces.push_back({.name = table.plain_name("name"),
                                   .grip = table.number("grip", {0.05, 1.2}),
                                   .source = table.text("source")});
  }
  if (regulation.surfaces.empty()) {
    root.reject("surfaces", "want at least one, got none");
  }
  regulation.least_braking = from_g(root.number("least_braking_g", {0.0, 1.0}));
  regulation.least_braking_source = root.text("least_braking_source");
  regulation.free_width = root.number("free_width_m", {2.0, 50.0});
  regulation.lane_width = root.number("lane_width_m", {2.0, 8.0});
  std::vector<TestTarget> targets;
  for (const Table& table : root.tables("targets")) {
    targets.push_back(read_target(table));
  }
  const auto car = std::find_if(targets.begin(), targets.end(),
                                [](const TestTarget& one) { return one.name == "car"; });
  if (car == targets.end()) {
    root.reject("targets", "want one whose name is car, got none");
  } else {
    regulation.car = *car;
  }
  std::set<std::string> names;
  for (Table table : root.tables("rows")) {
    regulation.rows.push_back(read_row(table, targets));
    if (!names.insert(regulation.rows.back().name).second) {
      table.reject("name",
                   "want each row's name once, got \"" + regulation.rows.back().name + "\" again");
    }
  }
  if (regulation.rows.empty()) {
    root.reject("rows", "want at least one, got none");
  }
  for (Table note : root.tables("notes")) {
    regulation.notes.push_back(note.text("text"));
  }
  return regulation;
}

}  // namespace

Result<Regulation> read_regulation(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema("saca.regulation/1");
  Regulation regulation = read_whole(root);
  if (const auto problem = document.value().error()) {
    return *problem;
  }
  return regulation;
}

Result<Regulation> load_regulation(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_regulation(text.value(), path.string());
}

}  // namespace saca::eval
