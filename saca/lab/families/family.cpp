#include "saca/lab/families/family.h"

#include <algorithm>
#include <array>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"
#include "saca/onboard/drivers/driver.h"

namespace saca::families {
namespace {

using config::Table;
using Keys = std::span<const std::string_view>;

constexpr std::array<std::string_view, num_family_kinds> kind_names{
    "crossing", "one_way", "lead_brakes", "cut_in",      "cut_out",   "pedestrian", "cyclist",
    "head_on",  "merge",   "dart_out",    "slower_lead", "sideswipe", "turning"};

// Every share is a probability.
constexpr std::array surroundings_list = std::to_array<std::string_view>(
    {"grip", "lane_width_m", "shoulder_m", "left_lane_share", "right_lane_share", "oncoming_share",
     "barrier_share", "trees_share", "kerb_share", "left_busy_share", "right_busy_share",
     "neighbour_gap_m", "neighbour_speed_share", "oncoming_ahead_m", "follower_share",
     "follower_gap_s", "follower_reaction_s"});

constexpr std::array crossing_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "other_speed_mps", "angle_deg", "late_s", "from_left_share", "van_share",
     "truck_share", "bystander_share", "bystander_ahead_m", "waiting_share", "waiting_ahead_m"});
constexpr std::array one_way_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "obstacle_length_m", "obstacle_width_m", "obstacle_offset_m", "ellipse_share",
     "second_share", "second_ahead_m", "second_aside_m", "second_size_m", "merging_share",
     "merging_ahead_m", "merging_speed_share", "merging_takes_s"});
constexpr std::array lead_brakes_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "gap_s", "deceleration_mps2", "van_share", "truck_share"});
constexpr std::array cut_in_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "slower_mps", "gap_m", "takes_s", "from_left_share", "brakes_share",
     "deceleration_mps2", "van_share", "truck_share"});
constexpr std::array cut_out_list =
    std::to_array<std::string_view>({"ego_speed_mps", "gap_s", "moves_out_at_s", "takes_s",
                                     "to_left_share", "offset_m", "van_share", "truck_share"});
constexpr std::array pedestrian_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "walk_mps", "run_mps", "chance_stop", "chance_run", "overlap",
     "from_left_share", "parked_share", "parked_ahead_m", "second_share", "second_aside_m"});
constexpr std::array cyclist_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "ride_mps", "along_share", "overlap", "from_left_share", "swerve_takes_s",
     "parked_share", "parked_ahead_m"});
constexpr std::array head_on_list =
    std::to_array<std::string_view>({"ego_speed_mps", "other_speed_mps", "drift_takes_s",
                                     "done_before_s", "drift_to_m", "van_share", "truck_share"});
constexpr std::array merge_list =
    std::to_array<std::string_view>({"ego_speed_mps", "speed_share", "ahead_m", "takes_s",
                                     "deceleration_mps2", "van_share", "truck_share"});
constexpr std::array dart_out_list =
    std::to_array<std::string_view>({"ego_speed_mps", "run_mps", "acceleration_mps2", "overlap",
                                     "from_left_share", "parked_row_m", "parked_gap_m"});
constexpr std::array slower_lead_list = std::to_array<std::string_view>(
    {"ego_speed_mps", "lead_mps", "offset_m", "van_share", "truck_share"});
constexpr std::array sideswipe_list =
    std::to_array<std::string_view>({"ego_speed_mps", "other_speed_mps", "beside_ahead_m",
                                     "takes_s", "from_left_share", "van_share", "truck_share"});
constexpr std::array turning_list =
    std::to_array<std::string_view>({"ego_speed_mps", "other_speed_mps", "from_deg", "turn_deg",
                                     "radius_m", "late_s", "van_share", "truck_share"});
constexpr std::string_view optional_key = "motorcycle_share";

bool is_share(std::string_view key) {
  return key.ends_with("_share") && key.find("speed") == key.npos;
}

/// What the number under a key can be at all; each range must lie inside.
config::Range bounds(std::string_view key) {
  if (is_share(key) || key.starts_with("chance_")) {
    return {0.0, 1.0};
  }
  if (key == "grip") {
    return {0.2, 1.0};
  }
  if (key == "ego_speed_mps") {
    return {1.0, 40.0};
  }
  if (key == "lane_width_m") {
    return {2.0, 6.0};
  }
  if (key == "angle_deg") {
    return {30.0, 150.0};
  }
  if (key == "from_deg" || key == "turn_deg") {
    return {-180.0, 180.0};
  }
  if (key == "radius_m") {
    return {3.0, 100.0};
  }
  if (key == "overlap") {
    return {-0.5, 1.5};
  }
  if (key.ends_with("reaction_s")) {
    return {0.0, drivers::longest_reaction};
  }
  if (key.ends_with("takes_s") || key.ends_with("length_m") || key.ends_with("width_m") ||
      key.ends_with("size_m") || key.ends_with("speed_mps") || key.ends_with("speed_share") ||
      key.ends_with("acceleration_mps2") || key.ends_with("deceleration_mps2") || key == "gap_s" ||
      key == "walk_mps" || key == "ride_mps" || key == "run_mps") {
    return {0.05, 100.0};  // nothing that is divided by, and no body without a size
  }
  const bool signed_place = key.ends_with("offset_m") || key.ends_with("ahead_m") ||
                            key.ends_with("late_s") || key == "done_before_s" ||
                            key == "neighbour_gap_m" || key == "drift_to_m" || key == "slower_mps";
  return {signed_place ? -100.0 : 0.0, 200.0};
}

FamilyRange read_range(Table table, std::string_view key) {
  const config::Range allowed = bounds(key);
  FamilyRange range;
  range.min = table.number("min", allowed);
  range.max = table.number("max", allowed);
  range.source = table.text("source");
  if (range.min > range.max) {
    table.reject("max", "want at least min: the range of " + std::string(key) + " is empty");
  }
  if (range.source.empty()) {
    table.reject("source", "want who says so, or \"assumption: ...\", got nothing");
  }
  return range;
}

/// Of what excludes each other the probabilities sum to at most 1.
void check_sums(const Family& family, Table& ranges) {
  constexpr double most = 1.0 + 1e-9;
  for (const std::vector<std::string>& together :
       {std::vector<std::string>{"van_share", "truck_share", std::string(optional_key)},
        {"barrier_share", "trees_share", "kerb_share"},
        {"chance_stop", "chance_run"}}) {
    double sum = 0.0;
    for (const std::string& key : together) {
      const auto range = family.ranges.find(key);
      sum += range == family.ranges.end() ? 0.0 : range->second.max;
    }
    if (sum > most) {
      ranges.reject(together.front(),
                    "want at most 1 together with what excludes it, got " + std::to_string(sum));
    }
  }
}

}  // namespace

std::string_view name(FamilyKind kind) {
  return name_of(kind, kind_names);
}
std::optional<FamilyKind> family_kind_from(std::string_view name) {
  return value_from<FamilyKind>(name, kind_names);
}

Keys own_keys(FamilyKind kind) {
  static constexpr std::array<Keys, num_family_kinds> keys{
      Keys(crossing_list), Keys(one_way_list),    Keys(lead_brakes_list), Keys(cut_in_list),
      Keys(cut_out_list),  Keys(pedestrian_list), Keys(cyclist_list),     Keys(head_on_list),
      Keys(merge_list),    Keys(dart_out_list),   Keys(slower_lead_list), Keys(sideswipe_list),
      Keys(turning_list)};
  return keys[static_cast<std::size_t>(kind)];
}

Keys surroundings_keys() {
  return surroundings_list;
}

Result<Family> read_family(std::string_view text, std::string_view source,
                           std::string_view surroundings, std::string_view surroundings_source) {
  const auto common = config::Document::parse(surroundings, surroundings_source);
  if (!common.has_value()) {
    return common.error();
  }
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Family family;
  common.value().root().want_schema("saca.surroundings/1");
  Table common_ranges = common.value().root().table("ranges");
  for (const std::string_view key : surroundings_list) {
    family.ranges[std::string(key)] = read_range(common_ranges.table(key), key);
  }
  Table root = document.value().root();
  root.want_schema("saca.family/1");
  family.name = root.plain_name("name");
  const std::string kind = root.text("kind");
  const auto known = family_kind_from(kind);
  if (!known) {
    root.reject("kind",
                "want crossing, one_way, lead_brakes, cut_in, cut_out, pedestrian, cyclist, "
                "head_on, merge, dart_out, slower_lead, sideswipe or turning, got \"" +
                    kind + "\"");
  }
  family.kind = known.value_or(FamilyKind::crossing);
  family.title = root.text("title");
  family.why = root.text("why");
  Table ranges = root.table("ranges");
  for (const std::string_view key : own_keys(family.kind)) {
    family.ranges[std::string(key)] = read_range(ranges.table(key), key);
  }
  if (ranges.has(optional_key) && family.ranges.contains("van_share")) {
    family.ranges[std::string(optional_key)] = read_range(ranges.table(optional_key), optional_key);
  }
  for (const std::string_view key : surroundings_list) {
    if (ranges.has(key)) {
      family.ranges[std::string(key)] = read_range(ranges.table(key), key);
    }
  }
  check_sums(family, ranges);
  for (const config::Document* file : {&common.value(), &document.value()}) {
    if (auto error = file->error()) {
      return *error;
    }
  }
  return family;
}

Result<Family> load_family(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path file = folder / (std::string(name) + ".toml");
  const std::filesystem::path common = folder / "surroundings.toml";
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  const auto common_text = read_file(common);
  if (!common_text.has_value()) {
    return common_text.error();
  }
  auto family = read_family(text.value(), file.string(), common_text.value(), common.string());
  if (family.has_value() && family.value().name != name) {
    return Error{Error::Code::malformed, file.string() + ": name: want \"" + std::string(name) +
                                             "\", as the file is called, got \"" +
                                             family.value().name + "\""};
  }
  return family;
}

}  // namespace saca::families
