#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"
#include "saca/lab/crash_records/recorded_speed.h"
#include "saca/lab/crash_records/roles.h"
#include "saca/lab/families/family.h"

namespace saca::crash_records {

/// The shipped families of the kinds that records are played with.
using BaseFamilies = std::map<families::FamilyKind, families::Family>;
/// @param folder  scenarios/families
[[nodiscard]] Result<BaseFamilies> load_base_families(const std::filesystem::path& folder);

/// All encounters that a record could tell of: the shipped family of its kind, with every number
/// narrowed that the record knows (speeds, who the other is, grip, lanes, from where he came).
///
/// Speeds are those of recorded_speed.h. The ego's body is that of the car that the family is
/// sampled for, not of the car of the record.
/// @return  Error::Code::out_of_range, in words, where no such encounter can be played: the ego
///          stood or went faster than 40 m/s, or was not faster than the one it ran into
[[nodiscard]] Result<families::Family> family_of(const FarsCrash& crash, const Roles& roles,
                                                 const FarsCodes& codes, const BaseFamilies& base);

/// "fars_2016_40001": also the name of the record's family.
[[nodiscard]] std::string record_name(const CrashId& id);

}  // namespace saca::crash_records
