#pragma once

#include <compare>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::crash_records {

// Crashes of the Fatality Analysis Reporting System (NHTSA), as its official CSV holds them:
// accident.csv, vehicle.csv and person.csv of one year, or several years of one state in one.
// Source of columns and codes: NHTSA, FARS Analytical User's Manual (DOT HS 812 448). Pre-crash
// columns stand in vehicle.csv from 2010 on.

/// What a coded column says; nullopt: it is not recorded, not reported or unknown.
using Code = std::optional<int>;

/// Names a crash in all releases.
struct CrashId {
  int year = 0;
  int number = 0;  ///< ST_CASE: the state's code times 10000, and the case in that state

  [[nodiscard]] int state() const { return number / 10'000; }
  auto operator<=>(const CrashId&) const = default;
};

/// A vehicle in transport. Names in brackets are those of the columns.
struct FarsVehicle {
  int number = 0;     ///< (VEH_NO), from 1
  Code body;          ///< (BODY_TYP)
  Code travel_speed;  ///< by the police report, before the crash (TRAV_SP) [mph]
  Code speed_limit;   ///< (VSPD_LIM) [mph]
  Code trafficway;    ///< (VTRAFWAY)
  Code lanes;         ///< (VNUM_LAN)
  Code alignment;     ///< (VALIGN)
  Code surface;       ///< (VSURCOND)
  Code manoeuvre;     ///< before the event (P_CRASH1)
  Code event;         ///< critical (P_CRASH2)
  Code avoidance;     ///< attempted (P_CRASH3)
  Code crash_type;    ///< (ACC_TYPE)
  Code impact;        ///< where it was hit first (IMPACT1)
};

struct FarsPerson {
  int vehicle = 0;  ///< (VEH_NO); 0: in none
  Code type;        ///< (PER_TYP)
  Code age;         ///< (AGE) [years]
  Code struck_by;   ///< the vehicle's number (STR_VEH)
  Code location;    ///< (LOCATION)
};

struct FarsCrash {
  CrashId id;
  bool in_accident_file = false;      ///< else the next three are not recorded
  Code light;                         ///< (LGT_COND)
  Code junction;                      ///< (RELJCT2)
  Code intersection;                  ///< (TYP_INT)
  std::vector<FarsVehicle> vehicles;  ///< by number
  std::vector<FarsPerson> persons;
};

/// One or more years of one or more states.
struct FarsRelease {
  std::vector<FarsCrash> crashes;  ///< by id
  std::vector<std::string> notes;  ///< what was passed over or is missing, in sentences
};

/// Reads the three files of a folder, whatever the case of their names.
///
/// The year is in the file (YEAR), else that of all crashes of accident.csv, which must then be of
/// one. A row whose number or code is none, or that is the second one of a vehicle or a crash, is
/// passed over and mentioned in the notes, and so is a crash of which accident.csv or person.csv
/// knows nothing.
/// @return  Error::Code::unreadable or malformed, naming file, column, wanted and got
[[nodiscard]] Result<FarsRelease> read_fars(const std::filesystem::path& folder);

/// Those of all releases, by id.
/// @return  Error::Code::malformed where a crash comes twice
[[nodiscard]] Result<FarsRelease> joined(std::vector<FarsRelease> releases);

}  // namespace saca::crash_records
