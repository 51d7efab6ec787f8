#include "saca/outcome/toll.h"

namespace saca::outcome {

Toll::Toll(const HarmModel& harm, const world::Scene& scene)
    : harm_(harm), scene_(scene), others_(scene.actors.size()), met_(scene.actors.size()) {}

double Toll::harm_if_certain() const {
  double sum = harm_.ego_people * weighted(harm_, ego_);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const double people = harm_.people[static_cast<std::size_t>(scene_.actors[i].kind)];
    sum += people * weighted(harm_, others_[i]);
  }
  return sum;
}

void Toll::add(const Blow& blow) {
  ego_ = combined(ego_, blow.ego);
  if (blow.contact.actor) {
    const std::size_t i = *blow.contact.actor;
    others_[i] = combined(others_[i], blow.other);
    if (!met_[i]) {
      met_[i] = true;
      chance_ *= scene_.actors[i].existence;
    }
  }
  const double before = certain_;
  certain_ = harm_if_certain();
  expected_ += chance_ * (certain_ - before);
}

}  // namespace saca::outcome
