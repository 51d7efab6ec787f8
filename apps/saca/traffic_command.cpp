#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/recordings/pack.h"
#include "saca/lab/recordings/recorded_set.h"
#include "saca/lab/recordings/set_file.h"
#include "saca/lab/recordings/set_info.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using recordings::PackProgress;
using recordings::PackResult;
using recordings::RecordedSet;

void print_set(const RecordedSet& set, bool as_json) {
  if (as_json) {
    app::print_json(recordings::set_json(set));
  } else {
    app::print("{}", recordings::set_text(set));
  }
}

struct TrafficPackOptions {
  std::vector<std::string> places;
  std::string output;
  bool as_json = false;
};

/// How a source's files are found and made a set.
struct PackSource {
  std::string name;
  std::string about;
  std::string ending;
  std::function<Result<PackResult>(const std::vector<fs::path>&, const PackProgress&)> pack;
};

int pack(const PackSource& source, const TrafficPackOptions& options) {
  const auto files =
      recordings::files_in({options.places.begin(), options.places.end()}, source.ending);
  if (!files.has_value()) {
    return refused(files.error());
  }
  if (files.value().empty()) {
    complain(fmt::format("{}: want files *{}, got none", options.places.front(), source.ending));
    return bad_input;
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine line("traffic " + source.name, static_cast<int>(files.value().size()),
                               clock, progress_display());
  const Result<PackResult> packed = source.pack(files.value(), [&](std::size_t done, std::size_t) {
    line.show(static_cast<int>(done), 0, "");
    return !long_work::interrupted();
  });
  if (!packed.has_value()) {
    return long_work::interrupted() ? static_cast<int>(was_interrupted) : refused(packed.error());
  }
  for (const std::string& message : packed.value().refused) {
    complain(message);
  }
  if (const auto problem = long_work::make_folder_of(options.output)) {
    return refused(*problem);
  }
  if (const auto problem = recordings::write_set(options.output, packed.value().set)) {
    return refused(*problem);
  }
  print_set(packed.value().set, options.as_json);
  return success;
}

void add_pack_source(CLI::App& command, const PackSource& source, int& exit_code) {
  CLI::App* const one = command.add_subcommand(source.name, source.about);
  const auto options = std::make_shared<TrafficPackOptions>();
  one->add_option("places", options->places, "Files, or folders in or below which they lie")
      ->required();
  one->add_option("-o,--output", options->output, "The set (HDF5)")->required();
  one->add_flag("--json", options->as_json, "For programs");
  one->callback([source, options, &exit_code] { exit_code = pack(source, *options); });
}

int show_info(const std::string& file, bool as_json) {
  const Result<RecordedSet> set = recordings::read_set(file);
  if (!set.has_value()) {
    return refused(set.error());
  }
  print_set(set.value(), as_json);
  return success;
}

}  // namespace

void add_traffic(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("traffic", "Recorded traffic as a set to learn from");
  command->require_subcommand(1);
  CLI::App* const packing = command->add_subcommand("pack", "Make a set of recordings");
  packing->require_subcommand(1);
  add_pack_source(
      *packing,
      {"commonroad", "CommonRoad files (XML 2020a) with recorded obstacles and lanelets", ".xml",
       recordings::pack_commonroad},
      exit_code);
  add_pack_source(*packing,
                  {"100car", "The 100-Car study's release: its events' cars", ".txt",
                   recordings::pack_hundred_car},
                  exit_code);
  add_pack_source(*packing,
                  {"ngsim", "NGSIM's own trajectories: CSV, the older text files, I-80's pairs",
                   ".csv", recordings::pack_ngsim},
                  exit_code);
  CLI::App* const info = command->add_subcommand("info", "What a set holds");
  const auto file = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  info->add_option("file", *file, "The set")->required();
  info->add_flag("--json", *as_json, "For programs");
  info->callback([file, as_json, &exit_code] { exit_code = show_info(*file, *as_json); });
}

}  // namespace saca::app
