#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::suites {

/// Encounter `number` of a source.
using EncounterAt = std::function<Result<eval::SuiteEncounter>(std::uint64_t number)>;

/// Where encounters come from: families of a suite, files, recordings or a table of the paper.
struct EncounterSource {
  std::string what;                ///< names all on which the encounters depend
  int count = 0;                   ///< as many as were asked for and there are
  std::vector<std::string> notes;  ///< on where they come from
  EncounterAt at;
};

/// Whether encounters have their twins without risk.
enum class Twins { played, left_out };

/// For which car, and how many encounters.
struct EncounterDraw {
  std::string car_name;
  const manoeuvre::Car* car = nullptr;  ///< of that name
  int count = 0;                        ///< at most
  Fnv played_with = {};                 ///< of all but the encounters themselves on which rows
                                        ///< depend: car, data, program
};

/// Every event of the 100-Car study that can be rebuilt, until an interrupt that is watched for.
/// @param data  the folder of the study's release: one
/// @return      an error as importers::import_hundred_cars; ::out_of_range: where no event can be
///              rebuilt, or the folders are not one
[[nodiscard]] Result<EncounterSource> hundred_car_source(const std::vector<std::string>& data,
                                                         const EncounterDraw& draw);

/// The scenarios of a folder (*.toml), by rising name.
/// @return  an error where there is none, or one that cannot be read
[[nodiscard]] Result<EncounterSource> folder_source(const std::string& folder,
                                                    const EncounterDraw& draw);

/// A table of the paper: its conditions one after the other, over and over.
/// @param table      name of one (eval::paper_tables)
/// @param scenarios  folder of those that ship
[[nodiscard]] Result<EncounterSource> paper_table_source(std::string_view table,
                                                         const std::filesystem::path& scenarios,
                                                         const EncounterDraw& draw, Twins twins);

/// What is drawn of the families of a suite.
/// @param what  names all on which the encounters depend
[[nodiscard]] EncounterSource drawn_source(eval::SuiteSource suite, std::string what, int count,
                                           Twins twins);

/// What can be asked for beside suites and families: recordings, tables of the paper, and the
/// regulations of a folder (data/protocols); sorted.
[[nodiscard]] std::vector<std::string> names_beside_suites(const std::filesystem::path& protocols);

}  // namespace saca::suites
