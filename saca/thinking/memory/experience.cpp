#include "saca/thinking/memory/experience.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/thinking/memory/learning.h"

namespace saca::memory {
namespace {

double weight_at(double difference, double reach) {
  const double apart = difference / reach;
  return std::exp(-0.5 * apart * apart);
}

}  // namespace

Policies as_good_as_best(const PolicyHarms& harms) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const std::optional<double>& harm : harms) {
    least = std::min(least, harm.value_or(least));
  }
  Policies good;
  for (std::size_t p = 0; p < harms.size(); ++p) {
    good[p] = harms[p] && *harms[p] <= least + as_good;
  }
  return good;
}

Policies as_good_as_best(const Case& one) noexcept {
  Policies good;
  if (!one.told && !one.happened) {
    good.set(manoeuvre::index(one.best));
    return good;
  }
  good.set();
  if (one.told) {
    good &= as_good_as_best(*one.told);
  }
  if (one.happened) {
    good &= as_good_as_best(*one.happened);
  }
  return good;
}

double confidence_at(double share) noexcept {
  struct Knot {
    double share;
    double confidence;
  };
  constexpr std::array<Knot, 4> knots{{{0.0, 0.0}, {0.62, 0.7}, {0.73, 0.9}, {1.0, 1.0}}};
  if (!(share > 0.0)) {
    return 0.0;
  }
  const auto* const above = std::find_if(knots.begin() + 1, knots.end() - 1,
                                         [share](const Knot& knot) { return share < knot.share; });
  const Knot& high = *above;
  const Knot& low = *(above - 1);
  return low.confidence + (std::min(share, 1.0) - low.share) / (high.share - low.share) *
                              (high.confidence - low.confidence);
}

Experience::Experience(std::span<const Case> cases) {
  for (const Case& one : cases) {
    Case numbered = one;
    numbered.id = last_id() + 1;
    add(numbered);
  }
}

Experience Experience::for_car(std::vector<MadeWith> car) {
  Experience experience;
  experience.car_ = std::move(car);
  return experience;
}

Experience::Lesson Experience::lesson_of(const Case& one) const {
  Lesson lesson{.good = as_good_as_best(one),
                .errors = {},
                .trusted = is_trusted_by(car_, one),
                .own = !car_.empty() && same_car_and_harm(one.made_with, car_),
                .of_another = !car_.empty() && !may_be_the_same_car(one.made_with, car_)};
  if (one.told && one.happened) {
    for (std::size_t p = 0; p < lesson.errors.size(); ++p) {
      const auto& told = (*one.told)[p];
      const auto& happened = (*one.happened)[p];
      if (told && happened) {
        lesson.errors[p] = std::clamp(*happened - *told, -most_counted, most_counted);
      }
    }
  }
  return lesson;
}

void Experience::add(const Case& one) {
  index_.add(one.id, one.scene);
  lessons_.push_back(lesson_of(one));
  has_others_ = has_others_ || lessons_.back().of_another;
  if (one.trust == Trust::quarantined) {
    pass_over(one.id);
  }
}

void Experience::relearn(const Case& one) {
  lessons_[index_.place_of(one.id)] = lesson_of(one);
  if (one.trust == Trust::quarantined) {
    pass_over(one.id);
  }
}

bool Experience::is_known_as(const Case& one) const {
  return lessons_[index_.place_of(one.id)] == lesson_of(one);
}

StaticVector<match::CaseId, Experience::most_same> Experience::same_encounter_as(
    const match::Features& scene) const noexcept {
  std::array<match::FeatureIndex::Hit, most_same> hits;
  const std::size_t found = index_.nearest(scene, hits);
  StaticVector<match::CaseId, most_same> same;
  for (std::size_t i = 0; i < found && hits[i].difference < same_encounter; ++i) {
    same.push_back(hits[i].id);
  }
  return same;
}

StaticVector<Experience::Hit, Experience::most_recalled> Experience::asked(
    std::span<const Hit> hits, std::span<const match::CaseId> except) const noexcept {
  StaticVector<Hit, most_recalled> kept;
  for (const Hit& hit : hits) {
    const bool is_known_by_itself =
        lessons_[hit.place].of_another &&
        std::any_of(hits.begin(), hits.end(), [&](const Hit& other) {
          return other.difference == hit.difference && lessons_[other.place].own;
        });
    const bool is_excepted = std::find(except.begin(), except.end(), hit.id) != except.end();
    if (!is_known_by_itself && !is_excepted && kept.size() < most_recalled) {
      kept.push_back(hit);
    }
  }
  return kept;
}

std::optional<Recall> Experience::recall(const match::Features& scene,
                                         std::span<const match::CaseId> except) const noexcept {
  std::array<Hit, 2 * most_recalled + most_excepted> room;
  const std::span<Hit> looked_at(room.data(),
                                 has_others_ ? room.size() : most_recalled + most_excepted);
  const auto hits = asked(looked_at.first(index_.nearest(scene, looked_at)), except);
  if (hits.empty()) {
    return std::nullopt;
  }
  std::array<double, manoeuvre::num_policies> for_it{};
  std::array<double, manoeuvre::num_policies> trusted{};
  double whole = doubt;
  for (const Hit& hit : hits) {
    const Lesson& lesson = lessons_[hit.place];
    const double weight = weight_at(hit.difference, recall_reach);
    whole += weight;
    for (std::size_t p = 0; p < for_it.size(); ++p) {
      for_it[p] += lesson.good[p] ? weight : 0.0;
      trusted[p] += lesson.good[p] && lesson.trusted ? weight : 0.0;
    }
  }
  const auto most =
      static_cast<std::size_t>(std::max_element(for_it.begin(), for_it.end()) - for_it.begin());
  Recall recall{.policy = manoeuvre::all_policies[most],
                .share = for_it[most] / whole,
                .trusted_share = trusted[most] / whole};
  const auto* const nearest = std::find_if(
      hits.begin(), hits.end(), [&](const Hit& hit) { return lessons_[hit.place].good[most]; });
  if (nearest == hits.end()) {
    return std::nullopt;  // in none of them did any policy do
  }
  recall.nearest = nearest->id;
  recall.similarity = match::similarity_at(nearest->difference);
  return recall;
}

Corrections Experience::corrections(const world::Scene& scene) const noexcept {
  std::array<match::FeatureIndex::Hit, most_corrected> hits;
  const std::size_t found = index_.nearest(match::features(scene), hits);
  Corrections sum{};
  Corrections weights;
  weights.fill(prior_cases);
  for (std::size_t i = 0; i < found; ++i) {
    const double weight = weight_at(hits[i].difference, correction_reach);
    const Errors& errors = lessons_[hits[i].place].errors;
    for (std::size_t p = 0; p < errors.size(); ++p) {
      if (errors[p]) {
        sum[p] += weight * *errors[p];
        weights[p] += weight;
      }
    }
  }
  for (std::size_t p = 0; p < sum.size(); ++p) {
    sum[p] /= weights[p];
  }
  return sum;
}

}  // namespace saca::memory
