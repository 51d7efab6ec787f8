#include "saca/thinking/rollout/batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <numeric>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/thinking/rollout/batch_level.h"
#include "saca/thinking/rollout/batch_start.h"

namespace saca::rollout {
namespace {

using LaneImage = lanes::Lane<float>;
using LaneStateVector = vehicle::equations::StateVector<float>;
constexpr std::size_t numbers_per_lane = sizeof(LaneImage) / sizeof(float);

lanes::Kernel kernel_for([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx2) {
    return lanes::kernel_avx2();
  }
  if (level == SimdLevel::avx512) {
    return lanes::kernel_avx512();
  }
#endif
  return lanes::kernel_baseline();
}

// What a plan ends with.
enum class EndsWith : std::uint8_t { nothing, rest, recovery };

EndsWith end_of(const manoeuvre::Plan& plan, const manoeuvre::ControllerState& memory) {
  if (plan.policy == manoeuvre::PolicyId::no_intervention) {
    return EndsWith::nothing;
  }
  const bool rests = plan.policy == manoeuvre::PolicyId::aeb || manoeuvre::drifts(plan.policy) ||
                     (manoeuvre::brakes_to_speed(plan.policy) &&
                      memory.speed < manoeuvre::equations::least_kept_speed);
  return rests ? EndsWith::rest : EndsWith::recovery;
}

// A drive before its first step.
struct DriveStart {
  LaneImage image;
  Pose X_WS;  // the frame it moves in, S: on its lane, abreast of where it starts
  EndsWith ends_with;
  int num_poses;  // beyond the first
};

DriveStart prepared(const Drive& drive, manoeuvre::EgoMotion& motion, double horizon) {
  constexpr int usual_poses = 255;  // most drives that end are over before

  expects(drive.car != nullptr, "a drive has a car");
  expects(drive.longest >= 0.0, "longest >= 0 s");
  const auto num_poses =
      static_cast<int>(std::lround(std::min(horizon, drive.longest) / lanes::pose_step));
  const manoeuvre::Ride ride(*drive.car, drive.plan, scene_of(drive), drive.grip,
                             drive.perturbation);
  const vehicle::VehicleState& state = ride.state();
  const double s = world::to_lane(drive.road, state.X_WB).s;
  const Pose X_WS = world::from_lane(drive.road, {.s = s, .d = 0.0, .heading = 0.0});
  motion.track.start = drive.start;
  motion.track.step = lanes::pose_step;
  const EndsWith ends_with = end_of(drive.plan, ride.memory());
  motion.track.X_WA.clear();
  motion.v_B.clear();
  motion.yaw_rate.clear();
  const auto foreseen =
      static_cast<std::size_t>(ends_with == EndsWith::nothing ? num_poses
                                                              : std::min(num_poses, usual_poses)) +
      1;
  motion.track.X_WA.reserve(foreseen);
  motion.v_B.reserve(foreseen);
  motion.yaw_rate.reserve(foreseen);
  motion.track.X_WA.push_back(state.X_WB);
  motion.v_B.push_back(state.v_B);
  motion.yaw_rate.push_back(state.yaw_rate);
  motion.ended = ride.ended();
  return {.image = {lanes::fixed_lane<float>(*drive.car, ride, drive.plan, drive.known_grip,
                                             drive.road.curvature),
                    lanes::moving_lane<float>(ride, inverse(X_WS) * state.X_WB, ride.memory())},
          .X_WS = X_WS,
          .ends_with = ends_with,
          .num_poses = num_poses};
}

// The lanes of one pack, and the drives in them.
class DrivePack {
 public:
  DrivePack(const lanes::Kernel& kernel, double horizon)
      : kernel_(kernel), horizon_(horizon), memory_(numbers_per_lane * kernel.num_lanes + 16) {
    void* start = memory_.data();
    std::size_t space = memory_.size() * sizeof(float);
    numbers_ = static_cast<float*>(std::align(64, space - 64, start, space));
  }

  // Drives all of `queue` (indices); drives of one kind and dead time.
  void drive(std::span<const Drive> drives, std::span<const std::size_t> queue,
             std::vector<manoeuvre::EgoMotion>& motions, lanes::Kind kind, std::size_t late) {
    const auto steps = static_cast<std::size_t>(lanes::steps_per_pose(kind));
    const lanes::Advance advance = kernel_.advance.at(static_cast<std::size_t>(kind));
    next_ = 0;
    num_busy_ = 0;
    for (std::size_t lane = 0; lane < kernel_.num_lanes; ++lane) {
      refill(lane, drives, queue, motions);
    }
    for (std::size_t now = lanes::num_slots; num_busy_ > 0; now += steps) {
      advance(numbers_, now, late);
      for (std::size_t lane = 0; lane < kernel_.num_lanes; ++lane) {
        if (lanes_[lane].motion != nullptr && !note(lane)) {
          refill(lane, drives, queue, motions);
        }
      }
    }
  }

 private:
  struct Busy {
    manoeuvre::EgoMotion* motion = nullptr;
    Pose X_WS;
    double cosine = 1.0;  // of its yaw
    double sine = 0.0;
    EndsWith ends_with = EndsWith::nothing;
    int num_poses = 0;
  };

  // The place of a number of the image, in one lane.
  [[nodiscard]] float& number(std::size_t which, std::size_t lane) {
    return numbers_[which * kernel_.num_lanes + lane];
  }
  [[nodiscard]] double state_vector(std::size_t which, std::size_t lane) {
    constexpr std::size_t first =
        (offsetof(LaneImage, moving) + offsetof(lanes::MovingLane<float>, state_vector)) /
        sizeof(float);
    return static_cast<double>(number(first + which, lane));
  }

  // Puts the next drive of the queue that takes more than no time into a lane.
  void refill(std::size_t lane, std::span<const Drive> drives, std::span<const std::size_t> queue,
              std::vector<manoeuvre::EgoMotion>& motions) {
    if (lanes_[lane].motion != nullptr) {
      --num_busy_;
    }
    lanes_[lane].motion = nullptr;
    while (next_ < queue.size()) {
      const std::size_t index = queue[next_++];
      manoeuvre::EgoMotion& motion = motions[index];
      const DriveStart start = prepared(drives[index], motion, horizon_);
      if (motion.ended || start.num_poses == 0) {
        continue;
      }
      put(start.image, lane);
      lanes_[lane] = {
          &motion,         start.X_WS,     std::cos(start.X_WS.yaw), std::sin(start.X_WS.yaw),
          start.ends_with, start.num_poses};
      ++num_busy_;
      return;
    }
  }

  void put(const LaneImage& image, std::size_t lane) {
    std::array<float, numbers_per_lane> values{};
    std::memcpy(values.data(), &image, sizeof(image));
    for (std::size_t i = 0; i < numbers_per_lane; ++i) {
      number(i, lane) = values[i];
    }
  }

  // Writes down where a lane's drive is; false when it has ended or its time is over.
  [[nodiscard]] bool note(std::size_t lane) {
    const Busy& busy = lanes_[lane];
    manoeuvre::EgoMotion& motion = *busy.motion;
    const double x = state_vector(LaneStateVector::x, lane);
    const double y = state_vector(LaneStateVector::y, lane);
    const Pose X_WB{{busy.X_WS.p.x + busy.cosine * x - busy.sine * y,
                     busy.X_WS.p.y + busy.sine * x + busy.cosine * y},
                    wrap_angle(busy.X_WS.yaw + state_vector(LaneStateVector::yaw, lane))};
    const Vec2 v_B{state_vector(LaneStateVector::vx, lane),
                   state_vector(LaneStateVector::vy, lane)};
    expects(is_finite(X_WB) && is_finite(v_B), "the drive stays finite");
    motion.track.X_WA.push_back(X_WB);
    motion.v_B.push_back(v_B);
    motion.yaw_rate.push_back(state_vector(LaneStateVector::yaw_rate, lane));
    motion.ended = has_ended(lane);
    return !motion.ended && static_cast<int>(motion.v_B.size()) <= busy.num_poses;
  }

  [[nodiscard]] bool has_ended(std::size_t lane) {
    constexpr std::size_t recovered =
        (offsetof(LaneImage, moving) + offsetof(lanes::MovingLane<float>, memory) +
         offsetof(lanes::MemoryLane<float>, recovered_for)) /
        sizeof(float);
    constexpr double sure = 0.2 - 1e-4;  // [s] as `finished`, less what sums of floats lose
    if (lanes_[lane].ends_with == EndsWith::recovery) {
      return static_cast<double>(number(recovered, lane)) >= sure;
    }
    if (lanes_[lane].ends_with == EndsWith::nothing) {
      return false;
    }
    for (std::size_t i = LaneStateVector::vx; i < LaneStateVector::wheel + vehicle::num_wheels;
         ++i) {
      if (state_vector(i, lane) != 0.0) {
        return false;
      }
    }
    return true;
  }

  lanes::Kernel kernel_;
  double horizon_;  // [s]
  std::vector<float> memory_;
  float* numbers_ = nullptr;
  std::array<Busy, lanes::most_lanes> lanes_{};
  std::size_t num_busy_ = 0;
  std::size_t next_ = 0;
};

// Which drives make one queue: those of one kind, and cars of one dead time; and where they stand
// in it: long ones first, so that lanes come to their ends together.
struct QueueKey {
  std::size_t late;
  lanes::Kind kind;
  bool ends;
  double minus_length;

  auto operator<=>(const QueueKey&) const = default;
};

QueueKey queue_key(const Drive& drive) {
  expects(drive.car != nullptr, "a drive has a car");
  const lanes::Kind kind = lanes::kind_of(drive.plan.policy);
  const double length = drive.ego.v_B.x / std::max(0.01, drive.grip * strength_of(drive.plan));
  const bool brakes = kind != lanes::Kind::keeps_speed;
  return {lanes::delay_of(*drive.car, kind).whole, kind,
          drive.plan.policy != manoeuvre::PolicyId::no_intervention,
          brakes && std::isfinite(length) ? -length : 0.0};
}

}  // namespace

Drive drive_from(const manoeuvre::Car& car, const manoeuvre::Plan& plan, const world::Scene& scene,
                 double longest) {
  return {.car = &car,
          .plan = plan,
          .start = scene.time,
          .ego = scene.ego,
          .road = scene.road,
          .known_grip = scene.grip,
          .grip = scene.grip,
          .perturbation = {},
          .longest = longest};
}

world::Scene scene_of(const Drive& drive) {
  world::Scene scene;
  scene.time = drive.start;
  scene.ego = drive.ego;
  scene.road = drive.road;
  scene.grip = drive.known_grip;
  return scene;
}

std::vector<manoeuvre::EgoMotion> drive_all(std::span<const Drive> drives, double horizon,
                                            int threads, SimdLevel level) {
  std::vector<manoeuvre::EgoMotion> motions;
  drive_all(drives, horizon, motions, threads, level);
  return motions;
}

void drive_all(std::span<const Drive> drives, double horizon,
               std::vector<manoeuvre::EgoMotion>& motions, int threads, SimdLevel level) {
  expects(horizon >= 0.0 && horizon <= 3600.0, "horizon in [0, 3600] s");
  expects(threads >= 1, "threads >= 1");
  expects(available(level), "the level is available");
  const lanes::Kernel kernel = kernel_for(level);
  std::vector<QueueKey> keys;
  keys.reserve(drives.size());
  for (const Drive& drive : drives) {
    keys.push_back(queue_key(drive));
  }
  std::vector<std::size_t> order(drives.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  // Queues of one kind and dead time, several for each thread.
  const std::size_t most =
      threads == 1 ? drives.size()
                   : std::max(4 * kernel.num_lanes,
                              drives.size() / (4 * static_cast<std::size_t>(threads)) + 1);
  std::vector<std::span<const std::size_t>> queues;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && end - begin < most &&
           keys[order[end]].late == keys[order[begin]].late &&
           keys[order[end]].kind == keys[order[begin]].kind) {
      ++end;
    }
    queues.emplace_back(order.data() + begin, end - begin);
    begin = end;
  }
  motions.resize(drives.size());
  in_parallel(queues.size(), threads, [&](std::size_t i) {
    const QueueKey& key = keys[queues[i].front()];
    DrivePack(kernel, horizon).drive(drives, queues[i], motions, key.kind, key.late);
  });
}

}  // namespace saca::rollout
