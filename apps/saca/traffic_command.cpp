#include <functional>

#include "apps/saca/options.h"
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

using recordings::PackProgress;
using recordings::PackResult;

/// How a source's files are found and made a set.
struct PackSource {
  std::string name;
  std::string about;
  std::string ending;
  std::function<Result<PackResult>(const std::vector<fs::path>&, const PackProgress&)> pack;
};

struct PackOptions {
  PackSource source;
  std::vector<std::string> places;
  std::string output;
  bool as_json = false;
};

void pack(const PackOptions& options) {
  const PackSource& source = options.source;
  const auto files =
      need(recordings::files_in({options.places.begin(), options.places.end()}, source.ending));
  if (files.empty()) {
    refuse(bad_input,
           fmt::format("{}: want files *{}, got none", options.places.front(), source.ending));
  }
  for (const fs::path& file : files) {
    need_distinct({{"--output", options.output}}, {{"a recording", file}});
  }
  need_writable({options.output});
  long_work::watch_for_interrupt();
  SteadyClock clock;
  long_work::ProgressLine line("traffic " + source.name, static_cast<int>(files.size()), clock,
                               progress_display());
  auto packing = source.pack(files, [&](std::size_t done, std::size_t) {
    line.show(static_cast<int>(done), 0, "");
    return !long_work::interrupted();
  });
  if (!packing.has_value() && long_work::interrupted()) {
    throw Exit{was_interrupted};
  }
  const PackResult packed = need(std::move(packing));
  complain_of(packed.refused);
  need(long_work::make_folder_of(options.output));
  need(recordings::write_set(options.output, packed.set));
  tell(options.as_json, recordings::set_json(packed.set), recordings::set_text(packed.set));
}

void add_source(CLI::App& packing, const PackSource& source) {
  const auto [command, options] =
      add_command<PackOptions>(packing, source.name, source.about, pack);
  options.source = source;
  add_needed(command, "places", options.places, "Files, or folders in or below which they lie");
  add_needed(command, "-o,--output", options.output, "The set (HDF5)");
  add_json(command, options.as_json);
}

struct SetOptions {
  std::string file;
  bool as_json = false;
};

void tell_set(const SetOptions& options) {
  const auto set = need(recordings::read_set(options.file));
  tell(options.as_json, recordings::set_json(set), recordings::set_text(set));
}

}  // namespace

void add_traffic(CLI::App& line) {
  CLI::App& traffic = add_group(line, "traffic", "Recorded traffic as a set to learn from");
  CLI::App& packing = add_group(traffic, "pack", "Make a set of recordings");
  add_source(packing,
             {"commonroad", "CommonRoad files (XML 2020a) with recorded obstacles and lanelets",
              ".xml", recordings::pack_commonroad});
  add_source(packing, {"100car", "The 100-Car study's release: its events' cars", ".txt",
                       recordings::pack_hundred_car});
  add_source(packing, {"ngsim", "NGSIM's own trajectories: CSV, the older text files, I-80's pairs",
                       ".csv", recordings::pack_ngsim});
  const auto [info, options] =
      add_command<SetOptions>(traffic, "info", "What a set holds", tell_set);
  add_needed(info, "file", options.file, "The set");
  add_json(info, options.as_json);
}

}  // namespace saca::app
