#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saca/lab/families/family.h"
#include "saca/lab/report/contact_sheet.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::family_samples {

// Samples of a family as pictures and for programs (`saca family`).

/// The encounter itself, or the same without risk.
enum class SampleSide { risk, twin };

[[nodiscard]] const scenario::Scenario& chosen(const families::FamilySample& sample,
                                               SampleSide side);

/// The family's sheet without any picture yet.
[[nodiscard]] report::ContactSheet empty_sheet(const families::Family& family);

/// A sample with what comes of doing nothing from the trigger on (from its start where it never
/// triggers), and what its cues are and bring.
[[nodiscard]] report::SceneView picture_of(const families::FamilySample& sample, SampleSide side,
                                           const manoeuvre::Car& car,
                                           const collision::HarmModel& harm);

/// One of "samples" of schema saca.family_samples/1. Its ego starts by itself.
/// @param file  in which it was written; empty: nowhere
[[nodiscard]] nlohmann::json json_of(const scenario::Scenario& scenario,
                                     const std::filesystem::path& file);

}  // namespace saca::family_samples
