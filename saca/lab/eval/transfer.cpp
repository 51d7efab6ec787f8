#include "saca/lab/eval/transfer.h"

#include <algorithm>
#include <map>
#include <random>
#include <string_view>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"

namespace saca::eval {
namespace {

constexpr double matters = 0.005;  // of harm: where policies differ by less, any will do

bool choice_matters(const memory::Case& one) {
  if (!one.told || !one.happened) {
    return false;
  }
  std::optional<double> least;
  std::optional<double> most;
  for (const std::optional<double>& harm : *one.happened) {
    if (harm) {
      least = std::min(least.value_or(*harm), *harm);
      most = std::max(most.value_or(*harm), *harm);
    }
  }
  return least && *most - *least > matters;
}

}  // namespace

std::string_view encounter_of(const memory::Case& one) {
  std::string_view source = one.source;
  if (constexpr std::string_view twin = "_twin"; source.ends_with(twin)) {
    source.remove_suffix(twin.size());
  }
  return source;
}

std::vector<Transfer> transfers(std::span<const memory::Case> cases,
                                std::span<const memory::Case> queries, std::uint64_t seed,
                                int threads) {
  expects(!cases.empty(), "there are cases to be asked");
  const memory::Experience bank(cases);
  std::map<std::string_view, std::vector<match::CaseId>> by_source;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i].source.empty()) {
      by_source[encounter_of(cases[i])].push_back(static_cast<match::CaseId>(i + 1));
    }
  }
  std::vector<std::optional<Transfer>> found(queries.size());
  in_parallel(queries.size(), threads, [&](std::size_t i) {
    const memory::Case& query = queries[i];
    if (!choice_matters(query)) {
      return;
    }
    const auto same = by_source.find(encounter_of(query));
    const auto recall =
        bank.recall(match::features(query.scene),
                    same == by_source.end() ? std::span<const match::CaseId>() : same->second);
    if (!recall) {
      return;
    }
    std::mt19937_64 rng(seed + i);
    const memory::Case& other =
        cases[std::uniform_int_distribution<std::size_t>(0, cases.size() - 1)(rng)];
    const memory::Policies in_truth = memory::as_good_as_best(*query.happened);
    const std::size_t policy = manoeuvre::index(recall->policy);
    found[i] = {.share = recall->share,
                .as_told = memory::as_good_as_best(*query.told).test(policy),
                .in_truth = in_truth.test(policy),
                .random_one = in_truth.test(manoeuvre::index(other.best)),
                .braking = in_truth.test(manoeuvre::index(manoeuvre::PolicyId::aeb))};
  });
  std::vector<Transfer> all;
  for (const std::optional<Transfer>& one : found) {
    if (one) {
      all.push_back(*one);
    }
  }
  return all;
}

std::optional<double> least_share(std::span<const Transfer> all, double part) {
  std::vector<Transfer> sorted(all.begin(), all.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Transfer& a, const Transfer& b) { return a.share > b.share; });
  std::optional<double> least;
  std::size_t good = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    good += sorted[i].in_truth ? 1U : 0U;
    const bool last_of_equals = i + 1 == sorted.size() || sorted[i + 1].share < sorted[i].share;
    if (last_of_equals && static_cast<double>(good) >= part * static_cast<double>(i + 1)) {
      least = sorted[i].share;
    }
  }
  return least;
}

TransferFigures transfer_figures(std::span<const Transfer> all, double from, double to) {
  TransferFigures figures;
  const auto count = [](learned_danger::Share& share, bool holds) {
    ++share.of;
    share.count += holds ? 1 : 0;
  };
  for (const Transfer& one : all) {
    const double confidence = memory::confidence_at(one.share);
    if (confidence > from && confidence <= to) {
      count(figures.in_truth, one.in_truth);
      count(figures.as_told, one.as_told);
      count(figures.random_one, one.random_one);
      count(figures.braking, one.braking);
    }
  }
  figures.coverage =
      all.empty() ? 0.0
                  : static_cast<double>(figures.in_truth.of) / static_cast<double>(all.size());
  return figures;
}

ShareInterval interval_of(const learned_danger::Share& share) {
  constexpr double one_sided = 0.975;
  return {.low = 1.0 - learned_danger::upper_bound({share.of - share.count, share.of}, one_sided),
          .high = learned_danger::upper_bound(share, one_sided)};
}

}  // namespace saca::eval
