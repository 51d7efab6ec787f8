#include "saca/lab/banks/case_neighbours.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "saca/onboard/match/feature_index.h"
#include "saca/onboard/match/similarity.h"

namespace saca::banks {
namespace {

constexpr std::size_t num_neighbours = 5;
constexpr std::size_t num_parts = 3;  // of a difference that are told

std::string difference_text(const memory::Case& one, const memory::Case& other) {
  auto parts = match::difference_parts(one.scene, other.scene);
  parts.resize(std::min(parts.size(), num_parts));
  std::string text;
  for (const match::DifferencePart& part : parts) {
    text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", part.what, part.size);
  }
  return text.empty() ? "the same scene" : "differs: " + text;
}

}  // namespace

std::vector<CaseNeighbour> nearest_cases(const memory::Case& one,
                                         std::span<const memory::Case> all) {
  match::FeatureIndex index;
  std::vector<const memory::Case*> others;
  for (const memory::Case& other : all) {
    if (other.id != one.id) {
      others.push_back(&other);
      index.add(static_cast<match::CaseId>(others.size()), other.scene);
    }
  }
  std::array<match::FeatureIndex::Hit, num_neighbours> hits;
  const std::size_t found = index.nearest(match::features(one.scene), hits);
  std::vector<CaseNeighbour> neighbours;
  neighbours.reserve(found);
  for (const match::FeatureIndex::Hit& hit : std::span(hits).first(found)) {
    const memory::Case& other = *others[hit.place];
    neighbours.push_back({.one = &other,
                          .similarity = match::similarity_at(hit.difference),
                          .differs = difference_text(one, other)});
  }
  return neighbours;
}

}  // namespace saca::banks
