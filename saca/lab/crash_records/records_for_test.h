#pragma once

// Records by construction, and a small release in the official form, for the tests of this module.

#include <filesystem>
#include <fstream>
#include <string>

#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"

namespace saca::crash_records {

inline const FarsCodes& shipped_codes() {
  static const FarsCodes codes = FarsCodes::load("data/crash_records/fars_codes.toml").value();
  return codes;
}

/// A passenger car that went straight on at 45 mph where 45 mph were allowed, on a dry two-way road
/// of two lanes.
inline FarsVehicle car_record(int number, int crash_type, int event) {
  return {.number = number,
          .body = 4,
          .travel_speed = 45,
          .speed_limit = 45,
          .trafficway = 1,
          .lanes = 2,
          .alignment = 1,
          .surface = 1,
          .manoeuvre = 1,
          .event = event,
          .avoidance = 1,
          .crash_type = crash_type,
          .impact = 12};
}

inline FarsCrash crash_record(std::vector<FarsVehicle> vehicles,
                              std::vector<FarsPerson> persons = {}) {
  return {.id = {.year = 2016, .number = 40001},
          .in_accident_file = true,
          .light = 1,
          .junction = 1,
          .intersection = 1,
          .vehicles = std::move(vehicles),
          .persons = std::move(persons)};
}

/// A car that ran into a slower one.
inline FarsCrash slower_ahead() {
  FarsVehicle lead = car_record(2, 25, 53);
  lead.travel_speed = 20;
  return crash_record({car_record(1, 24, 51), lead});
}

/// A car that struck somebody on foot.
inline FarsCrash struck_walker() {
  return crash_record({car_record(1, 13, 80)},
                      {{.vehicle = 0, .type = 5, .age = 30, .struck_by = 1, .location = 11}});
}

/// A folder with three files in the official form; the first two crashes of 2016, in one state.
class ReleaseForTest {
 public:
  static constexpr const char* vehicle_names =
      "STATE,ST_CASE,VEH_NO,BODY_TYP,BODY_TYPNAME,TRAV_SP,VSPD_LIM,VTRAFWAY,VNUM_LAN,VALIGN,"
      "VSURCOND,P_CRASH1,P_CRASH2,P_CRASH3,ACC_TYPE,IMPACT1";

  explicit ReleaseForTest(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() / ("saca_fars_" + name)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write("accident.csv",
          "STATE,ST_CASE,YEAR,LGT_COND,RELJCT2,TYP_INT\n4,40001,2016,2,1,1\n4,40002,2016,9,2,99\n");
    write("vehicle.csv", std::string(vehicle_names) +
                             "\n4,40001,2,4,\"Sedan, 4-door\",20,45,1,2,1,1,1,53,1,25,6\n"
                             "4,40001,1,4,\"Sedan, 4-door\",998,45,1,2,1,2,1,51,99,24,12\n"
                             "4,40002,1,4,\"Sedan, 4-door\",35,98,1,9,1,1,1,80,1,13,12\n");
    write("person.csv",
          "STATE,ST_CASE,VEH_NO,PER_TYP,AGE,STR_VEH,LOCATION\n"
          "4,40001,1,1,50,0,0\n4,40002,0,5,998,1,11\n");
  }
  ReleaseForTest(const ReleaseForTest&) = delete;
  ReleaseForTest& operator=(const ReleaseForTest&) = delete;
  ~ReleaseForTest() { std::filesystem::remove_all(folder_); }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }
  void remove(const std::string& file) const { std::filesystem::remove(folder_ / file); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace saca::crash_records
