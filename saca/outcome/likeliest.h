#pragma once

#include "saca/outcome/closer_look.h"
#include "saca/outcome/looks.h"
#include "saca/outcome/meeting.h"

namespace saca::outcome {

/// When contact is likeliest, and how likely then: at each instant the normal distribution at the
/// largest number of standard deviations of the gap along any axis; of all instants at the
/// smallest. Sets probability, and where it is not negligible nearest, gap
/// and n_W.
/// @param near   filled for the window
/// @param found  its contact is known
void find_likeliest(const CloserLook& pair, const Window& window, const NearLooks& near,
                    Meeting& found) noexcept;

}  // namespace saca::outcome
