#include "saca/lab/danger_study/data_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::danger_study {
namespace {

namespace fs = std::filesystem;
using learned_danger::Part;

/// Names all on which the parts depend.
std::string title_of(const DataSetTask& task) {
  return fmt::format("saca.transitions/1, car {}, seed {}, {} drives a part, {} features{}",
                     task.car.name, task.seed, task.drives_per_part, learned_danger::num_features,
                     task.tables == TableUse::none ? ", no tables" : "") +
         (task.network ? fmt::format(", by {:016x}", task.network->digest()) : "") +
         (task.outcomes ? ", outcomes" : "");
}

std::string card(const DataSetTask& task, const DataSetCounts& all) {
  return fmt::format(
      "# Transitions of a simulated car\n\n"
      "Nothing here was driven by anybody: all of it is simulated by `saca danger dataset` "
      "(car {}, seed {}), the car by a double track with combined slip, load transfer, actuators "
      "with lag and an anti-lock brake, its obstacles as bodies that hold their acceleration and "
      "curvature. Roads, edges and reactions of others are not in it.\n\n"
      "{} transitions of 0.1 s in {} situations, {} of which start within 2 m of the boundary "
      "between what a point mass can evade and what it cannot, beside {} different drives of the "
      "car; the other situations are the same drives beside other obstacles. {} bytes.\n\n"
      "Each `part_*.h5` is HDF5 in the layout of DSRL: observations, next_observations, actions, "
      "rewards, costs, terminals, timeouts; and h, next_h (signed, in metres) and drives. The text "
      "`features` names the numbers of an observation, in SI units and radians.\n",
      task.car_as_asked_for, task.seed, all.transitions, all.situations, all.near, all.drives,
      all.bytes);
}

Part made_part(const DataSetTask& task, const danger::DangerModel& model, std::size_t number) {
  Part part;
  part.car = task.car.name;
  Fnv seed;
  seed.add(fmt::format("{} {}", task.seed, number));
  part.seed = seed.value();
  if (task.outcomes) {
    part.mixture = learned_danger::mixture_of_outcomes();
  }
  part.transitions = learned_danger::made_transitions(
      task.car.car, manoeuvre::footprint(task.car.car), model, part.mixture,
      {.count = task.drives_per_part, .seed = part.seed}, task.network ? &*task.network : nullptr);
  return part;
}

}  // namespace

std::string part_line(std::size_t part, const DataSetCounts& one) {
  return fmt::format("{} {} {} {} {} {}", part, one.transitions, one.drives, one.situations,
                     one.near, one.bytes);
}

std::optional<std::pair<std::size_t, DataSetCounts>> part_from(const std::string& line) {
  std::array<std::int64_t, 6> numbers{};
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (std::int64_t& number : numbers) {
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc() || number < 0) {
      return std::nullopt;
    }
    at = read.ptr == end ? end : read.ptr + 1;
  }
  const auto [part, transitions, drives, situations, near, bytes] = numbers;
  return std::pair{static_cast<std::size_t>(part),
                   DataSetCounts{transitions, drives, situations, near, bytes}};
}

Result<DataSet> DataSet::open(DataSetTask task) {
  const fs::path journal_file = task.folder / "journal.txt";
  if (auto problem = long_work::make_folder_of(journal_file)) {
    return *std::move(problem);
  }
  auto journal = Journal::open(journal_file, title_of(task));
  if (!journal.has_value()) {
    return journal.error();
  }
  return DataSet(std::move(task), std::move(journal).value());
}

DataSet::DataSet(DataSetTask task, Journal journal)
    : task_(std::move(task)), journal_(std::move(journal)) {
  for (const std::string& line : journal_.lines()) {
    const auto one = part_from(line);
    if (one && fs::exists(file_of(one->first))) {
      made_[one->first] = one->second;
    }
  }
}

Result<DataSetCounts> DataSet::make(const danger::DangerModel& model) {
  if (auto stopped = make_all(model)) {
    return *std::move(stopped);
  }
  const DataSetCounts all = all_until(std::numeric_limits<std::size_t>::max());
  if (auto unwritten = write_file(task_.folder / "README.md", card(task_, all))) {
    return *std::move(unwritten);
  }
  return all;
}

fs::path DataSet::file_of(std::size_t part) const {
  return task_.folder / fmt::format("part_{:05}.h5", part);
}

DataSetCounts DataSet::all_until(std::size_t end) const {
  DataSetCounts sum;
  for (const auto& [part, one] : made_) {
    if (part < end) {
      sum.transitions += one.transitions;
      sum.drives += one.drives;
      sum.situations += one.situations;
      sum.near += one.near;
      sum.bytes += one.bytes;
    }
  }
  return sum;
}

std::optional<Error> DataSet::make_all(const danger::DangerModel& model) {
  const auto thousands = [](std::int64_t n) { return static_cast<int>(n / 1'000); };
  const auto made = [&] {
    return thousands(all_until(std::numeric_limits<std::size_t>::max()).transitions);
  };
  SteadyClock clock;
  long_work::ProgressLine line("danger dataset", std::max(1, thousands(task_.transitions)), clock,
                               task_.display);
  const int remembered = made();
  for (std::size_t first = 0; all_until(first).transitions < task_.transitions;
       first += static_cast<std::size_t>(task_.threads)) {
    if (long_work::interrupted()) {
      return Error{Error::Code::too_late, "interrupted; the same command goes on"};
    }
    if (auto problem = make_some(model, first)) {
      return problem;
    }
    line.show(std::min(thousands(task_.transitions), made()), remembered, " thousand transitions");
  }
  return std::nullopt;
}

std::optional<Error> DataSet::make_some(const danger::DangerModel& model, std::size_t first) {
  std::vector<std::size_t> missing;
  for (std::size_t k = first; k < first + static_cast<std::size_t>(task_.threads); ++k) {
    if (made_.count(k) == 0) {
      missing.push_back(k);
    }
  }
  std::vector<Part> parts(missing.size());
  in_parallel(missing.size(), task_.threads,
              [&](std::size_t i) { parts[i] = made_part(task_, model, missing[i]); });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (all_until(missing[i]).transitions >= task_.transitions) {
      break;  // how many are made at a time is nothing to whoever reads them
    }
    const fs::path file = file_of(missing[i]);
    if (auto problem = learned_danger::write_part(file, parts[i])) {
      return problem;
    }
    const learned_danger::Transitions& all = parts[i].transitions;
    const DataSetCounts one{
        static_cast<std::int64_t>(all.size()), static_cast<std::int64_t>(all.drives),
        static_cast<std::int64_t>(all.situations), static_cast<std::int64_t>(all.near),
        static_cast<std::int64_t>(fs::file_size(file))};
    if (!journal_.add(part_line(missing[i], one))) {
      return Error{Error::Code::unwritable,
                   task_.folder.string() + ": the journal cannot be written"};
    }
    made_[missing[i]] = one;
  }
  return std::nullopt;
}

nlohmann::json json_of(const DataSetTask& task, const DataSetCounts& all, double seconds) {
  return {{"danger.dataset.transitions", all.transitions},
          {"danger.dataset.drives", all.drives},
          {"danger.dataset.situations", all.situations},
          {"danger.dataset.near_boundary", all.near},
          {"danger.dataset.bytes", all.bytes},
          {"danger.dataset.seconds", seconds},
          {"meta.car", task.car_as_asked_for},
          {"meta.seed", std::to_string(task.seed)},
          {"meta.threads", task.threads}};
}

std::string text_of(const DataSetTask& task, const DataSetCounts& all) {
  return fmt::format(
             "{} transitions in {} situations, {} of which start near the boundary, of {} drives\n",
             all.transitions, all.situations, all.near, all.drives) +
         fmt::format("{:.2f} GB in {}\n", 1e-9 * static_cast<double>(all.bytes),
                     task.folder.string());
}

}  // namespace saca::danger_study
