#include "saca/lab/intention_study/example_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "saca/lab/intention_scoring/examples.h"
#include "saca/lab/intention_scoring/simulated.h"
#include "saca/lab/intention_scoring/split.h"
#include "saca/lab/recordings/set_file.h"

namespace saca::intention_study {
namespace {

using intention_scoring::Sequence;
using intention_scoring::SequenceSet;

/// What one split holds.
struct Share {
  std::vector<std::size_t> frames =
      std::vector<std::size_t>(intention_scoring::num_vehicle_classes, 0);
  std::set<std::string> groups;
  std::size_t doubtful = 0;
  std::size_t sequences = 0;
  std::size_t all = 0;  ///< frames
};

Share share_of(const SequenceSet& set, const std::string& split) {
  Share share;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    const Sequence& sequence = set.sequences[i];
    if (set.splits[i] != split) {
      continue;
    }
    ++share.sequences;
    share.groups.insert(sequence.group);
    share.all += sequence.labels.size();
    for (std::size_t t = 0; t < sequence.labels.size(); ++t) {
      sequence.scored[t] ? ++share.frames[sequence.labels[t]] : ++share.doubtful;
    }
  }
  return share;
}

}  // namespace

Result<SequenceSet> example_set(const ExampleRequest& request, int threads) {
  std::vector<Sequence> recorded;
  for (const std::string& file : request.sets) {
    const auto set = recordings::read_set(file);
    if (!set.has_value()) {
      return set.error();
    }
    auto some = intention_scoring::examples_of(set.value());
    std::move(some.begin(), some.end(), std::back_inserter(recorded));
  }
  SequenceSet all;
  for (const int part : intention_scoring::parts_of(recorded, request.parts)) {
    all.splits.push_back(fmt::format("part-{}", part));
  }
  all.sequences = std::move(recorded);
  // Of other seeds: what is tested was never trained with.
  for (const auto& [split, seed, count] :
       {std::tuple("simulated", request.seed, request.simulated),
        std::tuple("test", request.seed + 1, request.simulated / 2)}) {
    for (Sequence& each : intention_scoring::simulated_sequences(count, seed, threads)) {
      each.name = fmt::format("{} {}", split, each.name);
      all.sequences.push_back(std::move(each));
      all.splits.emplace_back(split);
    }
  }
  return all;
}

std::string shares_text(const SequenceSet& set) {
  const std::set<std::string> splits(set.splits.begin(), set.splits.end());
  std::string text =
      fmt::format("{:12} {:>9} {:>8} {:>8} | frames: M, LC, RC, FB, LB, RB; in doubt\n", "split",
                  "sequences", "groups", "hours");
  for (const std::string& split : splits) {
    const Share share = share_of(set, split);
    text += fmt::format("{:12} {:9} {:8} {:8.2f} |", split, share.sequences, share.groups.size(),
                        static_cast<double>(share.all) * intention_scoring::frame_step / 3600.0);
    for (const std::size_t count : share.frames) {
      text += fmt::format(" {}", count);
    }
    text += fmt::format("; {}\n", share.doubtful);
  }
  return text;
}

}  // namespace saca::intention_study
