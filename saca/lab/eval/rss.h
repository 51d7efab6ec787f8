#pragma once

#include <array>
#include <optional>

#include "saca/lab/encounter/method.h"
#include "saca/lab/eval/lane_view.h"

namespace saca::eval {

/// Parameters of responsibility-sensitive safety. Those that JRC's comparison of safety models for
/// UN R157 takes (github.com/ec-jrc/JRC-FSM, utility/vehicle.py): one set for everybody.
struct RssParameters {
  double response_time = 0.75;             ///< [s]
  double acceleration = 3.0;               ///< largest while responding [m/s^2]
  double braking = 6.0;                    ///< both least of who responds and largest of the other
  double side_acceleration = 1.0;          ///< likewise across the lane [m/s^2]
  double side_margin = 0.3;                ///< fluctuation across the lane [m]
  double response_braking = 0.774 * 9.81;  ///< what the response asks the brakes for [m/s^2]
};

// Source of the distances: S. Shalev-Shwartz, S. Shammah, A. Shashua, On a formal model of safe and
// scalable self-driving cars, arXiv 1708.06374, definitions 1, 2 and 6.

/// Least distance to who drives ahead in the same direction [m], >= 0.
/// @param rear   speed of who follows [m/s], >= 0
/// @param front  likewise of who is ahead
[[nodiscard]] double rss_following_distance(double rear, double front,
                                            const RssParameters& parameters = {});
/// Least distance to who comes towards one [m].
/// @param speed     [m/s], >= 0
/// @param oncoming  likewise of the other
[[nodiscard]] double rss_oncoming_distance(double speed, double oncoming,
                                           const RssParameters& parameters = {});
/// Least distance across the lane [m].
/// @param towards, other  how fast either comes nearer to the other [m/s]; < 0: it moves away
[[nodiscard]] double rss_side_distance(double towards, double other,
                                       const RssParameters& parameters = {});

/// Neither the distance along the lane nor that across is kept.
[[nodiscard]] bool rss_dangerous(const LaneView& view, const RssParameters& parameters = {});

/// RSS as a method: brakes as long as somebody ahead is dangerously near. It acts at the first look
/// at which a distance is not kept, and with all that its response asks for: unlike JRC's
/// implementation, which lets the response time pass first and builds the braking up with a jerk.
///
/// Roads are seen as lanes: who crosses is somebody ahead who does not move along the lane but
/// comes nearer across it.
class Rss final : public encounter::Method {
 public:
  enum class Response : std::uint8_t {
    braking,
    /// Where full braking comes too late, at first or while it brakes: a lane change to where the
    /// distances are kept.
    braking_or_steering,
  };

  explicit Rss(Response response) : response_(response) {}
  [[nodiscard]] std::optional<encounter::Action> step(const encounter::View& view) override;

 private:
  Response response_;
  RssParameters parameters_;
  bool brakes_ = false;
  bool steers_ = false;
};

}  // namespace saca::eval
