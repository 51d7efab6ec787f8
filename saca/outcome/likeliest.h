#pragma once

#include "saca/outcome/closer_look.h"
#include "saca/outcome/looks.h"
#include "saca/outcome/meeting.h"

namespace saca::outcome {

/// When contact is likeliest, and how likely then: at each instant the normal distribution at the
/// largest number of standard deviations of the gap along any axis; of all instants at the
/// smallest. Sets probability; where it is not negligible and the mean misses, also touch and
/// brought_W: the other is nearer to the ego by the mean of those errors that make them touch then,
/// and so it is on its whole way: the blow is where that first touches, at the speed that closes
/// there. Where the mean passes nothing closes, and a blow there would harm nobody.
/// @param near   filled for the window
/// @param found  its contact is known
void find_likeliest(const CloserLook& pair, const Window& window, const NearLooks& near,
                    Meeting& found) noexcept;

}  // namespace saca::outcome
