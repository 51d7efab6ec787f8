#include "saca/manoeuvre/atlas_build.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

#include "saca/core/contract.h"
#include "saca/core/fnv.h"
#include "saca/core/journal.h"
#include "saca/core/parallel.h"
#include "saca/manoeuvre/ego.h"
#include "saca/manoeuvre/ride.h"

namespace saca::manoeuvre {
namespace {

constexpr double least_width = 2.0;  // lanes that `refusal` allows [m]
constexpr double most_width = 6.0;
constexpr double longest_stop = 120.0;  // [s]
constexpr double keep_time = 20.0;      // as roll_out drives what never ends [s]

// Where on the grid.
struct Point {
  AtlasKind kind = AtlasKind::stop;
  double speed = 0.0;
  double grip = 0.0;
  double way = 0.0;
  double share = 0.0;
};

Point point_of(const AtlasGrid& grid, std::size_t number) {
  std::size_t kind = 0;
  while (number >= grid[kind].num_nodes()) {
    number -= grid[kind].num_nodes();
    ++kind;
    expects(kind < num_atlas_kinds, "number < num_nodes(grid)");
  }
  const AtlasAxes& axes = grid[kind];
  Point point{.kind = static_cast<AtlasKind>(kind)};
  point.share = axes.shares[number % axes.shares.size()];
  number /= axes.shares.size();
  point.way = axes.ways[number % axes.ways.size()];
  number /= axes.ways.size();
  point.grip = axes.grips[number % axes.grips.size()];
  point.speed = axes.speeds[number / axes.grips.size()];
  return point;
}

Plan plan_of(const Point& point) {
  switch (point.kind) {
    case AtlasKind::stop:
      return {PolicyId::aeb, std::nullopt};
    case AtlasKind::keep:
      return {PolicyId::no_intervention, std::nullopt};
    case AtlasKind::swerve:
      return {PolicyId::aes_left, std::nullopt};
    case AtlasKind::braked_swerve:
      return {PolicyId::es_b_left, point.share * point.speed};
    case AtlasKind::swerve_stop:
      return {PolicyId::es_b_left, 0.0};
    case AtlasKind::drift:
      break;
  }
  return {PolicyId::t_drift_left, std::nullopt};
}

// Straight along the lane; a way that no lane is wide enough for begins beside the middle.
world::Scene scene_of(const Car& car, const Point& point) {
  world::Scene scene;
  scene.grip = point.grip;
  scene.ego.v_B = {point.speed, 0.0};
  scene.ego_footprint = footprint(car);
  scene.ego_mass = car.mass;
  if (point.way > 0.0) {
    scene.road.lane_width = std::clamp(point.way, least_width, most_width);
    scene.ego.X_WB.p.y = scene.road.lane_width - point.way;
  }
  return scene;
}

// How long to follow what does not stop: past its end, and smooth over the grid, so that equal
// shares of it are alike on neighbouring nodes.
double span_of(const Point& point) {
  if (point.kind == AtlasKind::keep) {
    return keep_time;
  }
  const double g = vehicle::gravity;
  const double share = point.kind == AtlasKind::swerve ? 1.0 : point.share;
  return 1.5 + 2.0 * std::sqrt(point.way / (point.grip * g)) +
         3.0 * point.way / (share * point.speed) +
         (1.0 - share) * point.speed / (0.72 * point.grip * g);
}

// A drive as it was: six numbers every `step`, of the lane's frame at the start.
struct Trace {
  static constexpr int steps = 5;  // of the vehicle model between two looks
  static constexpr double step = steps * vehicle::usual_step;
  std::vector<std::array<double, 6>> look;  ///< x, y, heading, and their rates
  double length = 0.0;                      ///< [s]; the last look may come early
  double end = 0.0;                         ///< [s]
  bool ended = false;
};

std::array<double, 6> seen(const vehicle::VehicleState& state, double start_y, double heading) {
  const Vec2 v_L = rotated(state.v_B, state.X_WB.yaw);
  return {state.X_WB.p.x, state.X_WB.p.y - start_y, heading, v_L.x, v_L.y, state.yaw_rate};
}

// Follows a ride to rest, or for `span` where it does not end so.
Trace follow(const Car& car, const Point& point, double factor, double span) {
  const world::Scene scene = scene_of(car, point);
  Ride ride(car, plan_of(point), scene, std::min(1.2, point.grip * factor));
  const bool rests = ends_at_rest(point.kind);
  const auto num_steps =
      static_cast<long>(std::ceil((rests ? longest_stop : span) / vehicle::usual_step));
  const double start_y = scene.ego.X_WB.p.y;
  Trace trace;
  double heading = 0.0;
  trace.look.push_back(seen(ride.state(), start_y, heading));
  long k = 0;
  bool on = !(rests && ride.ended());
  while (on) {
    ride.step();
    ++k;
    if (!trace.ended && ride.ended()) {
      trace.ended = true;
      trace.end = static_cast<double>(k) * vehicle::usual_step;
    }
    on = k < num_steps && !(rests && trace.ended);
    if (k % Trace::steps == 0 || !on) {
      heading += wrap_angle(ride.state().X_WB.yaw - heading);
      trace.look.push_back(seen(ride.state(), start_y, heading));
    }
  }
  trace.length = static_cast<double>(k) * vehicle::usual_step;
  trace.ended = trace.ended || (rests && k == 0);
  trace.end = trace.ended ? trace.end : trace.length;
  return trace;
}

// All six numbers at a time; at rest beyond the end.
std::array<double, 6> at(const Trace& trace, double time) {
  const double place = time / Trace::step;
  const auto i = static_cast<std::size_t>(std::max(0.0, place));
  if (time >= trace.length || i + 1 >= trace.look.size()) {
    return trace.look.back();
  }
  const double span = std::min(Trace::step, trace.length - static_cast<double>(i) * Trace::step);
  const double u = std::min(1.0, (time - static_cast<double>(i) * Trace::step) / span);
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

void store_path(const Trace& trace, AtlasNode& node) {
  constexpr double last = atlas_samples - 1;
  const double span = static_cast<double>(node.span);
  std::array<std::array<double, atlas_samples>, 6> channel{};
  for (std::size_t i = 0; i < atlas_samples; ++i) {
    const auto values = at(trace, span * static_cast<double>(i) / last);
    for (std::size_t c = 0; c < 6; ++c) {
      channel[c][i] = c < 3 ? values[c] : values[c] * span / last;
    }
  }
  for (std::size_t c = 0; c < 6; ++c) {
    node.scale[c] = quantise(channel[c], node.path[c]);
  }
}

void store_sway(const Trace& middle, const Trace& other, std::size_t first, AtlasNode& node) {
  constexpr double last = sway_samples - 1;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, sway_samples> sway{};
    for (std::size_t i = 0; i < sway_samples; ++i) {
      const double time = static_cast<double>(node.sway_span) * static_cast<double>(i) / last;
      sway[i] = at(other, time)[c] - at(middle, time)[c];
    }
    node.sway_scale[first + c] = quantise(sway, node.sway[first + c]);
  }
}

// How far the body reaches to either side of where it starts.
void store_swept(const Car& car, const Trace& trace, AtlasNode& node) {
  const world::Footprint body = footprint(car);
  double left = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < trace.look.size(); ++i) {
    if (static_cast<double>(i) * Trace::step > trace.end + Trace::step) {
      break;
    }
    const Pose X_LB{{trace.look[i][0], trace.look[i][1]}, trace.look[i][2]};
    left = std::max(left, support(body, X_LB, {0.0, 1.0}).y);
    right = std::min(right, support(body, X_LB, {0.0, -1.0}).y);
  }
  node.swept_left = static_cast<float>(left);
  node.swept_right = static_cast<float>(right);
}

// The builder drives just beyond the domain too, so that every cell which touches it has corners.
Car unbounded(Car car) {
  car.tuning.domain.slowest.fill(0.0);
  car.tuning.domain.fastest.fill(fastest);
  return car;
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

std::string line_of(std::size_t number, const AtlasNode& node) {
  std::string line = std::to_string(number) + " ";
  for (const auto byte : std::bit_cast<std::array<unsigned char, sizeof(AtlasNode)>>(node)) {
    add_hex(line, byte, digits_per_byte);
  }
  return line;
}

// The node of a journal's line; nullopt: no such line.
std::optional<std::size_t> node_from(std::string_view line, std::vector<AtlasNode>& nodes) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const auto number = number_from<std::size_t>(line.substr(0, space), 10);
  const std::string_view digits = line.substr(std::min(space + 1, line.size()));
  std::array<unsigned char, sizeof(AtlasNode)> bytes{};
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
  nodes[*number] = std::bit_cast<AtlasNode>(bytes);
  return number;
}

std::string hex(std::uint64_t number) {
  std::string text;
  add_hex(text, number, digits_per_byte * sizeof number);
  return text;
}

// Names everything that the nodes depend on.
std::string title_of(const Car& car, const AtlasGrid& grid) {
  Fnv drives;
  for (const double number : behaviour(car)) {
    drives.add(std::bit_cast<std::uint64_t>(number));
  }
  return "saca atlas " + std::to_string(atlas_version) + " of car " + hex(car_hash(car)) +
         ", grid " + hex(grid_hash(grid)) + ", behaviour " + hex(drives.value());
}

template <class T>
void add_doubles(Fnv& hash, const T& values) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  for (const double number :
       std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(values)) {
    hash.add(std::bit_cast<std::uint64_t>(number));
  }
}

}  // namespace

std::uint64_t car_hash(const Car& car) {
  Fnv hash;
  add_doubles(hash, static_cast<const vehicle::Vehicle&>(car));
  add_doubles(hash, car.tuning.swerve);
  add_doubles(hash, car.tuning.drift);
  add_doubles(hash, car.tuning.domain);
  return hash.value();
}

std::uint64_t grid_hash(const AtlasGrid& grid) {
  Fnv hash;
  for (const AtlasAxes& axes : grid) {
    for (const AtlasAxes::Axis* axis : {&axes.speeds, &axes.grips, &axes.ways, &axes.shares}) {
      hash.add(axis->size());
      for (const double value : *axis) {
        hash.add(std::bit_cast<std::uint64_t>(value));
      }
    }
  }
  return hash.value();
}

Behaviour behaviour(const Car& car) {
  const Car driven = unbounded(car);
  Behaviour all{};
  auto out = all.begin();
  for (std::size_t kind = 0; kind < num_atlas_kinds; ++kind) {
    for (const double speed : {9.0, 15.0}) {
      const bool turns = kind >= static_cast<std::size_t>(AtlasKind::swerve) &&
                         static_cast<AtlasKind>(kind) != AtlasKind::drift;
      const Point point{static_cast<AtlasKind>(kind), speed, 0.8, turns ? 3.4 : 0.0, 0.5};
      const Trace trace = follow(driven, point, 0.9, 1.5);
      const auto last = trace.look.back();
      for (const double number : {last[0], last[1], last[2], trace.length}) {
        *out++ = number;
      }
    }
  }
  return all;
}

bool alike(const Behaviour& a, const Behaviour& b) {
  constexpr double tolerance = 1.5e-3;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) <= tolerance)) {
      return false;
    }
  }
  return true;
}

AtlasNode atlas_node(const Car& car, const AtlasGrid& grid, std::size_t number) {
  const Point point = point_of(grid, number);
  const Car driven = unbounded(car);
  const double span = ends_at_rest(point.kind) ? 0.0 : span_of(point);
  const Trace middle = follow(driven, point, 1.0, span);
  AtlasNode node;
  node.span = static_cast<float>(ends_at_rest(point.kind) ? middle.length : span);
  node.end = static_cast<float>(middle.end);
  node.ended = middle.ended ? 1 : 0;
  store_path(middle, node);
  const auto end = at(middle, middle.end);
  node.forward = static_cast<float>(end[0]);
  node.sideways = static_cast<float>(end[1]);
  store_swept(car, middle, node);
  if (point.kind == AtlasKind::keep) {
    return node;  // rolls on whatever the grip
  }
  const Trace less = follow(driven, point, 1.0 - sway_factor, span);
  const Trace more = follow(driven, point, 1.0 + sway_factor, span);
  node.sway_span = static_cast<float>(
      ends_at_rest(point.kind) ? std::max({middle.length, less.length, more.length}) : span);
  store_sway(middle, less, 0, node);
  store_sway(middle, more, 3, node);
  return node;
}

Result<AtlasNodes> build_atlas(const Car& car, const AtlasGrid& grid, int threads,
                               const std::filesystem::path& journal,
                               const std::function<bool(const AtlasProgress&)>& go_on) {
  const auto nodes = std::make_shared<std::vector<AtlasNode>>(num_nodes(grid));
  std::vector<char> known(nodes->size(), 0);
  AtlasProgress progress;
  std::optional<Journal> book;
  if (!journal.empty()) {
    auto opened = Journal::open(journal, title_of(car, grid));
    if (!opened.has_value()) {
      return opened.error();
    }
    book.emplace(std::move(opened).value());
    for (const std::string& line : book->lines()) {
      if (const auto number = node_from(line, *nodes)) {
        progress.remembered += known[*number] == 0 ? 1U : 0U;
        known[*number] = 1;
      }
    }
    progress.done = progress.remembered;
  }
  std::mutex lock;
  std::atomic<bool> stopped = !go_on(progress);
  bool written = true;
  in_parallel(nodes->size(), threads, [&](std::size_t i) {
    if (known[i] != 0 || stopped) {
      return;
    }
    (*nodes)[i] = atlas_node(car, grid, i);
    const std::lock_guard guard(lock);
    written = written && (!book || book->add(line_of(i, (*nodes)[i])));
    ++progress.done;
    if (!written || !go_on(progress)) {
      stopped = true;
    }
  });
  if (!written) {
    return Error{Error::Code::unwritable, journal.string() + ": cannot be written"};
  }
  return progress.done == nodes->size() ? AtlasNodes(nodes) : AtlasNodes();
}

}  // namespace saca::manoeuvre
