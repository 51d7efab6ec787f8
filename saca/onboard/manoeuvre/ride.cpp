#include "saca/onboard/manoeuvre/ride.h"

#include <algorithm>

#include "saca/base/core/contract.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::manoeuvre {

Ride::Ride(const Car& car, const Plan& plan, const world::Scene& scene, double grip,
           const ParameterPerturbation& perturbation)
    : car_(car),
      real_(real_car(car, perturbation)),
      grip_(std::min(1.2, grip * perturbation.grip)),
      plan_(plan),
      road_(scene.road),
      known_grip_(scene.grip) {
  expects(grip > 0.0 && grip <= 1.2 && grip_ > 0.0, "grip in (0, 1.2]");
  memory_ = begin(car_, plan_, scene);
  world::EgoState ego = scene.ego;
  ego.v_B.x =
      std::max(std::min(ego.v_B.x, 0.0), ego.v_B.x + perturbation.speed);  // never backwards
  state_ = rolling_state(real_, ego, grip_);
}

void Ride::step() {
  command_ = control(car_, road_, known_grip_, state_, memory_, vehicle::usual_step);
  state_ = vehicle::step(real_, state_, command_, grip_, vehicle::usual_step);
}

}  // namespace saca::manoeuvre
