#include "saca/lab/verification/authors_comparison.h"

#include "saca/base/core/units.h"

namespace saca::verification {
namespace {

double share(std::size_t part, std::size_t of, double of_none) {
  return of == 0 ? of_none : static_cast<double>(part) / static_cast<double>(of);
}

std::vector<AuthorsState> lattice_at(double speed) {
  std::vector<AuthorsState> states;
  for (int x = -50; x <= 0; ++x) {
    for (int y = -8; y <= 8; ++y) {
      for (int yaw = -40; yaw <= 40; yaw += 5) {
        states.push_back({static_cast<double>(x), static_cast<double>(y),
                          from_degrees(static_cast<double>(yaw)), speed});
      }
    }
  }
  return states;
}

void count(Agreement& agreement, double solved, double network) {
  ++agreement.states;
  agreement.unsafe += solved >= 0.0 ? 1 : 0;
  agreement.false_safe += solved >= 0.0 && !(network >= 0.0) ? 1 : 0;
  agreement.false_alarm += solved < 0.0 && network >= 0.0 ? 1 : 0;
}

void add(Agreement& sum, const Agreement& more) {
  sum.states += more.states;
  sum.unsafe += more.unsafe;
  sum.false_safe += more.false_safe;
  sum.false_alarm += more.false_alarm;
}

}  // namespace

double Agreement::sign_agreement() const {
  return share(states - false_safe - false_alarm, states, 1.0);
}
double Agreement::false_safe_share() const {
  return share(false_safe, unsafe, 0.0);
}
double Agreement::false_alarm_share() const {
  return share(false_alarm, states - unsafe, 0.0);
}

AuthorsComparison compare_with_authors(
    const danger::ValueAt& solved,
    const std::function<std::vector<double>(std::span<const AuthorsState>)>& network) {
  AuthorsComparison all;
  for (int speed = 0; speed <= 18; ++speed) {
    AuthorsComparison::AtSpeed here{.speed = static_cast<double>(speed)};
    const std::vector<AuthorsState> states = lattice_at(here.speed);
    const std::vector<double> values = network(states);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const danger::LookupResult found =
          solved({states[i].x, states[i].y, states[i].yaw, states[i].speed});
      if (!found.inside) {
        ++all.outside;
        continue;
      }
      count(here.agreement, found.value, values[i]);
      here.mean_solved += found.value;
      here.mean_network += values[i];
    }
    if (here.agreement.states > 0) {
      here.mean_solved /= static_cast<double>(here.agreement.states);
      here.mean_network /= static_cast<double>(here.agreement.states);
      add(all.all, here.agreement);
      all.by_speed.push_back(here);
    }
  }
  return all;
}

AuthorsComparison compare_with_authors(const danger::ValueAt& solved,
                                       const AuthorsNetwork& network) {
  return compare_with_authors(
      solved, [&](std::span<const AuthorsState> states) { return network.values(states); });
}

}  // namespace saca::verification
