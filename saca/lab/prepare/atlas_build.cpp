#include "saca/lab/prepare/atlas_build.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/onboard/atlas/atlas_identity.h"
#include "saca/onboard/atlas/atlas_point.h"
#include "saca/thinking/rollout/batch.h"

namespace saca::prepare {
namespace {

constexpr double keep_time = 20.0;  // of what never ends [s]
constexpr std::size_t nodes_at_once = 32;

// How long to follow what does not stop: past its end, and smooth over the grid, so that equal
// shares of it are alike on neighbouring nodes.
double span_of(const atlas::AtlasPoint& point) {
  if (point.kind == atlas::AtlasKind::keep) {
    return keep_time;
  }
  const double g = vehicle::gravity;
  const double share = point.kind == atlas::AtlasKind::swerve ? 1.0 : point.share;
  return 1.5 + 2.0 * std::sqrt(point.way / (point.grip * g)) +
         3.0 * point.way / (share * point.speed) +
         (1.0 - share) * point.speed / (0.72 * point.grip * g);
}

// All six numbers at a time. Beyond its end a drive stays where it is, or keeps to its lane.
std::array<double, 6> at(const atlas::AtlasTrace& trace, double time) {
  const double place = std::max(0.0, time / trace.step);
  const auto i = static_cast<std::size_t>(place);
  if (i + 1 >= trace.look.size()) {
    const std::array<double, 6>& last = trace.look.back();
    return {
        last[0] + last[3] * std::max(0.0, time - trace.end), last[1], last[2], last[3], 0.0, 0.0};
  }
  const double u = place - static_cast<double>(i);
  std::array<double, 6> values{};
  for (std::size_t c = 0; c < 6; ++c) {
    values[c] = trace.look[i][c] + u * (trace.look[i + 1][c] - trace.look[i][c]);
  }
  return values;
}

// As integers, with the scale that makes the largest just fit.
template <std::size_t n>
float quantise(const std::array<double, n>& values, std::array<std::int16_t, n>& numbers) {
  double most = 0.0;
  for (const double value : values) {
    most = std::max(most, std::abs(value));
  }
  const auto scale = static_cast<float>(most / 32'767.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double number = scale > 0.0F ? values[i] / static_cast<double>(scale) : 0.0;
    numbers[i] = static_cast<std::int16_t>(std::clamp(std::lround(number), -32'767L, 32'767L));
  }
  return scale;
}

void store_path(const atlas::AtlasTrace& trace, atlas::AtlasNode& node) {
  constexpr double last = atlas::atlas_samples - 1;
  const double span = static_cast<double>(node.span);
  std::array<std::array<double, atlas::atlas_samples>, 6> channel{};
  for (std::size_t i = 0; i < atlas::atlas_samples; ++i) {
    const auto values = at(trace, span * static_cast<double>(i) / last);
    for (std::size_t c = 0; c < 6; ++c) {
      channel[c][i] = c < 3 ? values[c] : values[c] * span / last;
    }
  }
  for (std::size_t c = 0; c < 6; ++c) {
    node.scale[c] = quantise(channel[c], node.path[c]);
  }
}

void store_sensitivity(const atlas::AtlasTrace& middle, const atlas::AtlasTrace& other,
                       std::size_t first, atlas::AtlasNode& node) {
  constexpr double last = atlas::sensitivity_samples - 1;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, atlas::sensitivity_samples> sensitivity{};
    for (std::size_t i = 0; i < atlas::sensitivity_samples; ++i) {
      const double time =
          static_cast<double>(node.sensitivity_span) * static_cast<double>(i) / last;
      sensitivity[i] = at(other, time)[c] - at(middle, time)[c];
    }
    node.sensitivity_scale[first + c] = quantise(sensitivity, node.sensitivity[first + c]);
  }
}

// A point of the grid, and its drives on the grip of `grip_factors`.
constexpr std::array grip_factors{1.0, 1.0 - atlas::sensitivity_grip_step,
                                  1.0 + atlas::sensitivity_grip_step};
struct Node {
  atlas::AtlasPoint point;
  std::array<atlas::AtlasTrace, grip_factors.size()> traces;
};

// How long it is followed: what stops, to rest.
double longest_of(const atlas::AtlasPoint& point) {
  return atlas::ends_at_rest(point.kind) ? atlas::longest_stop : span_of(point);
}

void drive_nodes(const manoeuvre::Car& driven, std::vector<Node>& nodes) {
  std::vector<rollout::Drive> drives;
  for (const Node& node : nodes) {
    const atlas::AtlasPoint& point = node.point;
    const world::Scene scene = scene_of(driven, point);
    for (const double factor : grip_factors) {
      drives.push_back({.car = &driven,
                        .plan = atlas::plan_of(point),
                        .ego = scene.ego,
                        .road = scene.road,
                        .known_grip = point.grip,
                        .grip = std::min(1.2, point.grip * factor),
                        .longest = std::ceil(longest_of(point))});
    }
  }
  const std::vector<manoeuvre::EgoMotion> motions = rollout::drive_all(drives, atlas::longest_stop);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    Node& node = nodes[k / grip_factors.size()];
    node.traces[k % grip_factors.size()] = atlas::trace_of(motions[k], longest_of(node.point));
  }
}

atlas::AtlasNode stored_node(const Node& driven) {
  const auto& [middle, less, more] = driven.traces;
  const bool rests = atlas::ends_at_rest(driven.point.kind);
  atlas::AtlasNode node;
  node.span = static_cast<float>(rests ? middle.end : span_of(driven.point));
  node.end = static_cast<float>(middle.end);
  node.ended = middle.ended ? 1 : 0;
  store_path(middle, node);
  if (driven.point.kind == atlas::AtlasKind::keep) {
    return node;  // rolls on whatever the grip
  }
  node.sensitivity_span = static_cast<float>(rests ? std::max({middle.end, less.end, more.end})
                                                   : span_of(driven.point));
  store_sensitivity(middle, less, 0, node);
  store_sensitivity(middle, more, 3, node);
  return node;
}

constexpr std::size_t digits_per_byte = 2;

// A number in hexadecimal, of so many digits.
void add_hex(std::string& text, std::uint64_t number, std::size_t digits) {
  std::array<char, 16> some{};
  const char* const end = std::to_chars(some.begin(), some.end(), number, 16).ptr;
  const auto size = static_cast<std::size_t>(end - some.begin());
  text.append(digits - size, '0').append(some.data(), size);
}

// The whole of a text as a number; nullopt: it is none.
template <class T>
std::optional<T> number_from(std::string_view text, int base) {
  T number{};
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number, base);
  return problem == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

std::string line_of(std::size_t number, const atlas::AtlasNode& node) {
  std::string line = std::to_string(number) + " ";
  for (const auto byte : std::bit_cast<std::array<unsigned char, sizeof(atlas::AtlasNode)>>(node)) {
    add_hex(line, byte, digits_per_byte);
  }
  return line;
}

// The node of a journal's line; nullopt: no such line.
std::optional<std::size_t> node_from(std::string_view line, std::vector<atlas::AtlasNode>& nodes) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const auto number = number_from<std::size_t>(line.substr(0, space), 10);
  const std::string_view digits = line.substr(std::min(space + 1, line.size()));
  std::array<unsigned char, sizeof(atlas::AtlasNode)> bytes{};
  if (!number || *number >= nodes.size() || digits.size() != digits_per_byte * bytes.size()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte =
        number_from<unsigned char>(digits.substr(digits_per_byte * i, digits_per_byte), 16);
    if (!byte) {
      return std::nullopt;
    }
    bytes[i] = *byte;
  }
  nodes[*number] = std::bit_cast<atlas::AtlasNode>(bytes);
  return number;
}

std::string hex(std::uint64_t number) {
  std::string text;
  add_hex(text, number, digits_per_byte * sizeof number);
  return text;
}

// Names everything that the nodes depend on.
std::string title_of(const manoeuvre::Car& car, const atlas::AtlasGrid& grid) {
  Fnv drives;
  drives.add_doubles(atlas::behaviour(car));
  return "saca atlas " + std::to_string(atlas::atlas_version) + " of car " +
         hex(atlas::car_hash(car)) + ", grid " + hex(atlas::grid_hash(grid)) + ", behaviour " +
         hex(drives.value());
}

// What is known of an atlas that is being built.
struct KnownNodes {
  std::shared_ptr<std::vector<atlas::AtlasNode>> nodes;
  std::vector<char> is_known;      // of each node
  std::optional<Journal> journal;  // that remembers them

  [[nodiscard]] std::vector<std::size_t> unknown() const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < is_known.size(); ++i) {
      if (is_known[i] == 0) {
        numbers.push_back(i);
      }
    }
    return numbers;
  }
};

Result<KnownNodes> known_nodes(const manoeuvre::Car& car, const atlas::AtlasGrid& grid,
                               const std::filesystem::path& journal) {
  KnownNodes known{.nodes = std::make_shared<std::vector<atlas::AtlasNode>>(atlas::num_nodes(grid)),
                   .is_known = std::vector<char>(atlas::num_nodes(grid), 0),
                   .journal = {}};
  if (journal.empty()) {
    return known;
  }
  auto opened = Journal::open(journal, title_of(car, grid));
  if (!opened.has_value()) {
    return opened.error();
  }
  known.journal.emplace(std::move(opened).value());
  for (const std::string& line : known.journal->lines()) {
    if (const auto number = node_from(line, *known.nodes)) {
      known.is_known[*number] = 1;
    }
  }
  return known;
}

}  // namespace

std::vector<atlas::AtlasNode> atlas_nodes(const manoeuvre::Car& car, const atlas::AtlasGrid& grid,
                                          std::span<const std::size_t> numbers) {
  const manoeuvre::Car driven = atlas::unbounded(car);
  std::vector<Node> nodes;
  for (const std::size_t number : numbers) {
    nodes.push_back({atlas::point_of(grid, number), {}});
  }
  drive_nodes(driven, nodes);
  std::vector<atlas::AtlasNode> stored;
  std::transform(nodes.begin(), nodes.end(), std::back_inserter(stored), stored_node);
  return stored;
}

Result<AtlasNodes> build_atlas(const manoeuvre::Car& car, const atlas::AtlasGrid& grid, int threads,
                               const std::filesystem::path& journal,
                               const std::function<bool(const AtlasProgress&)>& go_on) {
  auto opened = known_nodes(car, grid, journal);
  if (!opened.has_value()) {
    return opened.error();
  }
  KnownNodes known = std::move(opened).value();
  const std::vector<std::size_t> unknown = known.unknown();
  AtlasProgress progress;
  progress.remembered = known.nodes->size() - unknown.size();
  progress.done = progress.remembered;
  std::mutex lock;
  std::atomic<bool> stopped = !go_on(progress);
  bool written = true;
  const std::size_t num_lots = (unknown.size() + nodes_at_once - 1) / nodes_at_once;
  in_parallel(num_lots, threads, [&](std::size_t lot) {
    if (stopped) {
      return;
    }
    const std::size_t first = lot * nodes_at_once;
    const std::span numbers =
        std::span(unknown).subspan(first, std::min(nodes_at_once, unknown.size() - first));
    const std::vector<atlas::AtlasNode> done = atlas_nodes(car, grid, numbers);
    const std::lock_guard guard(lock);
    for (std::size_t k = 0; k < done.size(); ++k) {
      (*known.nodes)[numbers[k]] = done[k];
      written = written && (!known.journal || known.journal->add(line_of(numbers[k], done[k])));
    }
    progress.done += done.size();
    if (!written || !go_on(progress)) {
      stopped = true;
    }
  });
  if (!written) {
    return Error{Error::Code::unwritable, journal.string() + ": cannot be written"};
  }
  return progress.done == known.nodes->size() ? AtlasNodes(known.nodes) : AtlasNodes();
}

}  // namespace saca::prepare
