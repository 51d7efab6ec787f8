#include "saca/lab/recordings/repeats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace saca::recordings {
namespace {

constexpr std::size_t fewest_common = 10;  // samples that tell two tracks to be one, or are kept
constexpr double alike_speed = 0.02;       // [m/s]: files round speeds to 0.01 or finer
constexpr double alike_way = 0.3;          // [m]
constexpr double least_change = 0.3;       // of the speed [m/s]: less looks alike at any time

/// What a vehicle keeps from file to file: id and size [cm]; -1 where not known.
using Key = std::tuple<std::string, std::int64_t, std::int64_t, std::int64_t>;

std::int64_t centimetres(double length) {
  return std::isnan(length) ? -1 : std::llround(100.0 * length);
}
Key key_of(const Recording& recording, const RecordedVehicle& vehicle) {
  return {recording.site, vehicle.id, centimetres(vehicle.length), centimetres(vehicle.width)};
}

/// Disjoint sets, each member with its clock's difference to the set's first.
class Clocks {
 public:
  explicit Clocks(std::size_t size) : parent_(size), ahead_(size, 0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// The set of a member, and how many steps the set's clock shows at the member's 0.
  [[nodiscard]] std::pair<std::size_t, std::int64_t> find(std::size_t member) const {
    std::int64_t ahead = 0;
    for (; parent_[member] != member; member = parent_[member]) {
      ahead += ahead_[member];
    }
    return {member, ahead};
  }
  /// b's 0 is at a's `ahead`.
  void join(std::size_t a, std::size_t b, std::int64_t ahead) {
    const auto [root_a, ahead_a] = find(a);
    const auto [root_b, ahead_b] = find(b);
    if (root_a != root_b) {
      parent_[root_b] = root_a;
      ahead_[root_b] = ahead_a + ahead - ahead_b;
    }
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<std::int64_t> ahead_;
};

std::int64_t first_step(const Recording& recording, const RecordedVehicle& vehicle) {
  return std::llround(vehicle.start / recording.step);
}

double way_between(const RecordedVehicle& vehicle, std::size_t from, std::size_t to) {
  return norm(vehicle.samples[to].X_WA.p - vehicle.samples[from].X_WA.p);
}

/// Whether a[first_a + k] and b[first_b + k] are the same motion, k < count.
bool same_motion(const RecordedVehicle& a, std::size_t first_a, const RecordedVehicle& b,
                 std::size_t first_b, std::size_t count) {
  double least = a.samples[first_a].speed;
  double most = least;
  for (std::size_t k = 0; k < count; ++k) {
    const double speed = a.samples[first_a + k].speed;
    if (!(std::abs(speed - b.samples[first_b + k].speed) <= alike_speed)) {
      return false;
    }
    least = std::min(least, speed);
    most = std::max(most, speed);
  }
  if (most - least < least_change) {
    return false;
  }
  for (const std::size_t k : {count / 2, count - 1}) {
    const double difference =
        way_between(a, first_a, first_a + k) - way_between(b, first_b, first_b + k);
    if (!(std::abs(difference) <= alike_way)) {
      return false;
    }
  }
  return true;
}

/// Whether its speed can tell a time at all.
bool changes_speed(const RecordedVehicle& vehicle) {
  const auto [least, most] =
      std::minmax_element(vehicle.samples.begin(), vehicle.samples.end(),
                          [](const Sample& a, const Sample& b) { return a.speed < b.speed; });
  return most->speed - least->speed >= least_change;
}

/// Where b's first sample is among a's, < 0 before them, if they are one motion and at one place
/// only.
std::optional<std::int64_t> alignment(const RecordedVehicle& a, const RecordedVehicle& b) {
  const auto size_a = static_cast<std::int64_t>(a.samples.size());
  const auto size_b = static_cast<std::int64_t>(b.samples.size());
  constexpr auto least = static_cast<std::int64_t>(fewest_common);
  std::optional<std::int64_t> found;
  if (!changes_speed(a) || !changes_speed(b)) {
    return found;
  }
  for (std::int64_t shift = least - size_b; shift <= size_a - least; ++shift) {
    const std::int64_t first_a = std::max<std::int64_t>(shift, 0);
    const std::int64_t first_b = first_a - shift;
    const std::int64_t count = std::min(size_a - first_a, size_b - first_b);
    if (same_motion(a, static_cast<std::size_t>(first_a), b, static_cast<std::size_t>(first_b),
                    static_cast<std::size_t>(count))) {
      if (found) {
        return std::nullopt;
      }
      found = shift;
    }
  }
  return found;
}

/// Steps that b's clock is behind a's: b's 0 is a's result.
std::optional<std::int64_t> clock_difference(const Recording& a, const Recording& b) {
  if (a.site != b.site || std::abs(a.step - b.step) > 1e-9) {
    return std::nullopt;
  }
  std::multimap<Key, const RecordedVehicle*> in_a;
  for (const RecordedVehicle& vehicle : a.vehicles) {
    in_a.emplace(key_of(a, vehicle), &vehicle);
  }
  std::map<std::int64_t, std::size_t> votes;
  std::size_t voters = 0;
  for (const RecordedVehicle& vehicle : b.vehicles) {
    const auto [from, to] = in_a.equal_range(key_of(b, vehicle));
    for (auto other = from; other != to; ++other) {
      if (const auto shift = alignment(*other->second, vehicle)) {
        ++votes[first_step(a, *other->second) + *shift - first_step(b, vehicle)];
        ++voters;
      }
    }
  }
  const auto most = std::max_element(
      votes.begin(), votes.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
  if (most == votes.end() || 2 * most->second < voters) {
    return std::nullopt;
  }
  return most->first;
}

Clocks clocks_of(const std::vector<Recording>& recordings) {
  Clocks clocks(recordings.size());
  for (std::size_t a = 0; a < recordings.size(); ++a) {
    for (std::size_t b = a + 1; b < recordings.size(); ++b) {
      if (recordings[a].group != recordings[b].group ||
          clocks.find(a).first == clocks.find(b).first) {
        continue;
      }
      if (const auto ahead = clock_difference(recordings[a], recordings[b])) {
        clocks.join(a, b, *ahead);
      }
    }
  }
  return clocks;
}

/// A track's place on its clock.
struct Pass {
  RecordedVehicle* vehicle = nullptr;
  double step = 0.1;
  std::int64_t first = 0;  ///< step of the clock at its first sample
};

/// The longest run of samples that nobody has: first and size.
std::pair<std::size_t, std::size_t> longest_free(const Pass& pass,
                                                 const std::set<std::int64_t>& taken) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  std::size_t run = 0;
  for (std::size_t k = 0; k < pass.vehicle->samples.size(); ++k) {
    run = taken.contains(pass.first + static_cast<std::int64_t>(k)) ? 0 : run + 1;
    if (run > best.second) {
      best = {k + 1 - run, run};
    }
  }
  return best;
}

/// Leaves each instant to the longest pass that has it; a pass without enough is emptied.
void share_out(std::vector<Pass>& passes, Repeats& repeats) {
  std::stable_sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) {
    return a.vehicle->samples.size() > b.vehicle->samples.size();
  });
  std::set<std::int64_t> taken;
  for (const Pass& pass : passes) {
    std::vector<Sample>& samples = pass.vehicle->samples;
    const auto [first, size] = longest_free(pass, taken);
    if (size == samples.size()) {
      // Nobody has any of it.
    } else if (size < fewest_common) {
      ++repeats.passes;
      samples.clear();
      continue;
    } else {
      repeats.samples += samples.size() - size;
      const auto from = samples.begin() + static_cast<std::ptrdiff_t>(first);
      samples = std::vector<Sample>(from, from + static_cast<std::ptrdiff_t>(size));
      samples.front().lane_step = 0;  // nobody sees the sample before any more
      pass.vehicle->start += static_cast<double>(first) * pass.step;
    }
    for (std::size_t k = 0; k < size; ++k) {
      taken.insert(pass.first + static_cast<std::int64_t>(first + k));
    }
  }
}

void count(RecordedSet& set, const char* reason, std::size_t number) {
  if (number > 0) {
    set.skipped[reason] += number;
  }
}

}  // namespace

void name_groups(RecordedSet& set) {
  Clocks groups(set.recordings.size());
  std::map<Key, std::size_t> first_with;
  for (std::size_t k = 0; k < set.recordings.size(); ++k) {
    for (const RecordedVehicle& vehicle : set.recordings[k].vehicles) {
      const auto [found, is_new] = first_with.emplace(key_of(set.recordings[k], vehicle), k);
      if (!is_new) {
        groups.join(found->second, k, 0);
      }
    }
  }
  std::map<std::size_t, std::string> names;
  std::map<std::string, int> num_of_site;
  for (std::size_t k = 0; k < set.recordings.size(); ++k) {
    Recording& recording = set.recordings[k];
    std::string& name = names[groups.find(k).first];
    if (name.empty()) {
      name = recording.site + "-" + std::to_string(++num_of_site[recording.site]);
    }
    recording.group = name;
  }
}

Repeats drop_repeats(RecordedSet& set) {
  const Clocks clocks = clocks_of(set.recordings);
  Repeats repeats;
  std::map<std::pair<std::size_t, Key>, std::vector<Pass>> passes;
  std::set<std::size_t> all_clocks;
  for (std::size_t k = 0; k < set.recordings.size(); ++k) {
    Recording& recording = set.recordings[k];
    const auto [clock, ahead] = clocks.find(k);
    all_clocks.insert(clock);
    for (RecordedVehicle& vehicle : recording.vehicles) {
      passes[{clock, key_of(recording, vehicle)}].push_back(
          {&vehicle, recording.step, ahead + first_step(recording, vehicle)});
    }
  }
  repeats.clocks = all_clocks.size();
  for (auto& [key, of_one] : passes) {
    share_out(of_one, repeats);
  }
  for (Recording& recording : set.recordings) {
    std::erase_if(recording.vehicles, [](const RecordedVehicle& v) { return v.samples.empty(); });
  }
  repeats.recordings =
      std::erase_if(set.recordings, [](const Recording& r) { return r.vehicles.empty(); });
  count(set, "vehicle: kept from another file", repeats.passes);
  count(set, "sample: kept from another file", repeats.samples);
  count(set, "file: all its vehicles are kept from others", repeats.recordings);
  return repeats;
}

}  // namespace saca::recordings
