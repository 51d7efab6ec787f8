#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "saca/lab/learned_danger/margins.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"

namespace saca::eval {

/// Name of the encounter that a case is of, and its twin without risk too ("..._twin").
[[nodiscard]] std::string_view encounter_of(const memory::Case& one);

/// One recall, held against what is known of the scene that it was for.
struct Transfer {
  double share = 0.0;       ///< memory::Recall::share
  bool as_told = false;     ///< the policy is as good as the best by what was expected there,
  bool in_truth = false;    ///< by what happened
  bool random_one = false;  ///< the same of the policy of a case drawn from all, in truth
  bool braking = false;     ///< and of braking
};

/// Of those queries of which it is known what was told and what happened, and in which the choice
/// matters: what policies truly harm differs by more than 0.005.
/// @param cases    that are asked, at least one
/// @param queries  held against them. Where one has a source, cases of the same are left out, those
///                 of its twin without risk too (*_twin): so cases may be held against one another
/// @param seed     of what is drawn
/// @param threads  >= 1; they do not change the result
[[nodiscard]] std::vector<Transfer> transfers(std::span<const memory::Case> cases,
                                              std::span<const memory::Case> queries,
                                              std::uint64_t seed, int threads);

/// The least share from which on, all recalls with so much or more taken together, at least this
/// part transfers in truth; nullopt: from none on.
[[nodiscard]] std::optional<double> least_share(std::span<const Transfer> all, double part);

/// How recalls of one range of confidence do.
struct TransferFigures {
  double coverage = 0.0;  ///< part of all queries
  learned_danger::Share in_truth;
  learned_danger::Share as_told;
  learned_danger::Share random_one;
  learned_danger::Share braking;
};
/// @param from  least confidence (memory::confidence_at), not in the range itself
/// @param to    largest, in it
[[nodiscard]] TransferFigures transfer_figures(std::span<const Transfer> all, double from,
                                               double to);

/// The exact two-sided 95 % interval of a share.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};
[[nodiscard]] ShareInterval interval_of(const learned_danger::Share& share);

}  // namespace saca::eval
