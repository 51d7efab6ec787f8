#include "saca/lab/recordings/ngsim_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "saca/base/core/percentile.h"
#include "saca/base/core/units.h"
#include "saca/lab/recordings/recording_of_map.h"

namespace saca::recordings {
namespace {

constexpr double bin_length = 10.0;             // [m]
constexpr std::size_t bins_beside = 2;          // on either side: five in all
constexpr std::size_t fewest_rows = 30;         // in them: some thirty vehicles pass each
constexpr double usual_lane = from_feet(12.0);  // [m]
constexpr double least_spacing = 2.5;           // of lanes' centres [m]
constexpr double most_spacing = 5.5;
constexpr std::size_t heading_frames = 10;  // a second
constexpr double least_way = 1.0;           // that tells a heading [m]
constexpr double most_along = 1e5;          // [m]: of a section

std::size_t bin_of(double along) {
  return static_cast<std::size_t>(std::clamp(along, 0.0, most_along) / bin_length);
}

/// Medians of bins, each then the median of those around it.
std::vector<double> smooth_medians(const std::vector<std::vector<double>>& bins) {
  std::vector<double> medians;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    std::vector<double> around;
    std::size_t rows = 0;
    const std::size_t first = k > bins_beside ? k - bins_beside : 0;
    for (std::size_t i = first; i <= std::min(k + bins_beside, bins.size() - 1); ++i) {
      rows += bins[i].size();
      if (!bins[i].empty()) {
        around.push_back(percentile(bins[i], 0.5));
      }
    }
    medians.push_back(rows >= fewest_rows && !bins[k].empty() ? percentile(around, 0.5)
                                                              : not_known);
  }
  return medians;
}

}  // namespace

NgsimLanes::NgsimLanes(const std::vector<NgsimRow>& rows) {
  std::map<int, std::vector<std::vector<double>>> bins;
  for (const NgsimRow& row : rows) {
    std::vector<std::vector<double>>& of_lane = bins[row.lane];
    const std::size_t bin = bin_of(row.along);
    of_lane.resize(std::max(of_lane.size(), bin + 1));
    of_lane[bin].push_back(row.right);
    end_ = std::max(end_, row.along);
  }
  for (const auto& [lane, of_lane] : bins) {
    centres_[lane] = smooth_medians(of_lane);
  }
}

std::optional<double> NgsimLanes::centre(int lane, double along) const {
  const auto found = centres_.find(lane);
  if (found == centres_.end()) {
    return std::nullopt;
  }
  // On the straight line between the middles of two bins; of one that is known alone, that.
  const std::vector<double>& of_lane = found->second;
  const double place = std::max(0.0, along / bin_length - 0.5);
  const auto bin = static_cast<std::size_t>(std::min(place, most_along));
  const double first = bin < of_lane.size() ? of_lane[bin] : not_known;
  const double next = bin + 1 < of_lane.size() ? of_lane[bin + 1] : not_known;
  if (std::isnan(first) && std::isnan(next)) {
    return std::nullopt;
  }
  const double share = place - static_cast<double>(bin);
  return std::isnan(first) ? next : std::isnan(next) ? first : first + share * (next - first);
}

std::optional<NgsimLanes::Lane> NgsimLanes::at(int lane, double along) const {
  const std::optional<double> here = centre(lane, along);
  if (!here) {
    return std::nullopt;
  }
  const double before = centre(lane, along - bin_length).value_or(*here);
  const double after = centre(lane, along + bin_length).value_or(*here);
  Lane made{.right = *here, .slope = (after - before) / (2.0 * bin_length), .width = usual_lane};
  double sum = 0.0;
  double count = 0.0;
  for (const int side : {-1, 1}) {
    const std::optional<double> beside = centre(lane + side, along);
    const double spacing = beside ? side * (*beside - *here) : 0.0;
    if (spacing >= least_spacing && spacing <= most_spacing) {
      (side < 0 ? made.left_lane : made.right_lane) = true;
      sum += spacing;
      count += 1.0;
    }
  }
  made.width = count > 0.0 ? sum / count : usual_lane;
  return made;
}

namespace {

/// Rows in order, each instant of a vehicle once.
std::vector<NgsimRow> ordered(std::vector<NgsimRow> rows,
                              std::map<std::string, std::size_t>& skipped) {
  const auto place = [](const NgsimRow& row) { return std::tie(row.vehicle, row.frame); };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const NgsimRow& a, const NgsimRow& b) { return place(a) < place(b); });
  const auto end = std::unique(rows.begin(), rows.end(), [&](const NgsimRow& a, const NgsimRow& b) {
    return place(a) == place(b);
  });
  if (end != rows.end()) {
    skipped["row: a vehicle's second in one frame"] += static_cast<std::size_t>(rows.end() - end);
    rows.erase(end, rows.end());
  }
  return rows;
}

/// A recording's rows, ordered, with what is to be looked up in them.
struct Section {
  std::vector<NgsimRow> rows;
  NgsimLanes lanes;

  [[nodiscard]] const NgsimRow* find(std::int64_t vehicle, std::int64_t frame) const {
    const auto found = std::lower_bound(rows.begin(), rows.end(), std::pair(vehicle, frame),
                                        [](const NgsimRow& row, const auto& wanted) {
                                          return std::pair(row.vehicle, row.frame) < wanted;
                                        });
    const bool is_it = found != rows.end() && found->vehicle == vehicle && found->frame == frame;
    return is_it ? &*found : nullptr;
  }
};

void set_gap(const Section& section, const NgsimRow& row, Sample& sample) {
  constexpr double nobody = std::numeric_limits<double>::infinity();
  if (row.preceding == 0) {
    if (section.lanes.end() - row.along >= lead_reach) {
      sample.gap = nobody;
    }
    return;
  }
  double along = row.lead_along;
  double length = row.lead_length;
  double speed = row.lead_speed;
  const bool is_told = !std::isnan(along);
  const NgsimRow* const lead = is_told ? nullptr : section.find(row.preceding, row.frame);
  if (lead != nullptr) {
    along = lead->along;
    length = lead->length;
    speed = lead->speed;
  }
  const double gap = along - length - row.along;
  if (gap <= lead_reach) {
    sample.gap = gap;
    sample.lead_speed = speed;
  } else if (!std::isnan(gap)) {
    sample.gap = nobody;
  }
}

/// Frames of one vehicle on end, as samples.
std::vector<Sample> samples_of_track(const Section& section, std::span<const NgsimRow> rows) {
  std::vector<Sample> samples;
  double yaw = not_known;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const NgsimRow& row = rows[k];
    const std::optional<NgsimLanes::Lane> lane = section.lanes.at(row.lane, row.along);
    const double lane_yaw = lane ? -std::atan(lane->slope) : 0.0;
    const NgsimRow& before = rows[k > heading_frames ? k - heading_frames : 0];
    const Vec2 way_W{row.along - before.along, before.right - row.right};
    if (norm(way_W) >= least_way) {
      yaw = std::atan2(way_W.y, way_W.x);
    }
    Sample sample;
    sample.X_WA.yaw = std::isnan(yaw) ? lane_yaw : yaw;
    const Vec2 front_W{row.along, -row.right};
    sample.X_WA.p = front_W - rotated({0.5 * row.length, 0.0}, sample.X_WA.yaw);
    sample.speed = row.speed;
    if (lane) {
      const double behind = row.along - sample.X_WA.p.x;
      sample.offset = (sample.X_WA.p.y + lane->right - lane->slope * behind) * std::cos(lane_yaw);
      sample.heading = wrap_angle(sample.X_WA.yaw - lane_yaw);
      sample.lane_width = lane->width;
      sample.left_lane = lane->left_lane;
      sample.right_lane = lane->right_lane;
      const int moved = k > 0 ? rows[k - 1].lane - row.lane : 0;  // lanes count from the left
      sample.lane_step = std::clamp(moved, -1, 1);
    }
    set_gap(section, row, sample);
    samples.push_back(sample);
  }
  return samples;
}

std::string type_of(int vehicle_class) {
  return vehicle_class == 1 ? "motorcycle" : vehicle_class == 3 ? "truck" : "car";
}

/// Whether a row goes on with the track of the one before.
bool goes_on(const NgsimRow& before, const NgsimRow& row) {
  return row.vehicle == before.vehicle && row.frame == before.frame + 1 &&
         row.length == before.length && row.width == before.width;
}

void add_vehicles(const Section& section, Recording& recording,
                  std::map<std::string, std::size_t>& skipped) {
  const std::vector<NgsimRow>& rows = section.rows;
  for (std::size_t from = 0; from < rows.size();) {
    std::size_t to = from + 1;
    while (to < rows.size() && goes_on(rows[to - 1], rows[to])) {
      ++to;
    }
    const NgsimRow& first = rows[from];
    if (to - from < fewest_packed) {
      ++skipped["vehicle: fewer than 10 samples on end"];
    } else {
      recording.vehicles.push_back(
          {.id = first.vehicle,
           .type = type_of(first.vehicle_class),
           .length = first.length,
           .width = first.width,
           .start = ngsim_step * static_cast<double>(first.frame),
           .samples = samples_of_track(section, std::span(rows).subspan(from, to - from))});
    }
    from = to;
  }
}

}  // namespace

RecordedSet set_of_ngsim(const NgsimTable& table, const std::string& name) {
  RecordedSet set;
  set.skipped = table.skipped;
  std::map<std::string, int> num_of_site;
  for (const auto& [key, rows] : table.recordings) {
    const int number = ++num_of_site[key.site];
    Recording recording{name + " minute " + std::to_string(key.minute),
                        key.site,
                        key.site + "-" + std::to_string(number),
                        ngsim_step,
                        {}};
    std::vector<NgsimRow> in_order = ordered(rows, set.skipped);
    const NgsimLanes lanes(in_order);
    add_vehicles({std::move(in_order), lanes}, recording, set.skipped);
    if (!recording.vehicles.empty()) {
      set.recordings.push_back(std::move(recording));
    }
  }
  return set;
}

}  // namespace saca::recordings
