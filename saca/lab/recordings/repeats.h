#pragma once

#include <cstddef>

#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

// Databases cut one recording into many files that overlap. Vehicles keep their ids and sizes; time
// and coordinates begin anew in each file.

/// Names the groups: recordings of one site that share a vehicle (by id, length and width, both to
/// a centimetre), directly or through others, get the same name, `us101-1`, `us101-2`, ... in the
/// recordings' order.
void name_groups(RecordedSet& set);

/// What was dropped.
struct Repeats {
  std::size_t clocks = 0;      ///< stretches of time that are left: no sample of one is in another
  std::size_t passes = 0;      ///< tracks of which too little was left
  std::size_t samples = 0;     ///< of tracks that were cut, without those
  std::size_t recordings = 0;  ///< of which no track was left
};

/// Keeps each instant of a vehicle once, in the longest of its tracks, and counts the rest in
/// `set.skipped`.
///
/// Two recordings of a group are put on one clock where shared vehicles that change their speed
/// show the same speeds (within 0.02 m/s) and the same way (within 0.3 m; a shift and a turn of the
/// coordinates change neither) over all samples in common, 10 or more, at the same difference of
/// the clocks: at least half of those that can tell. Of a track that is partly kept elsewhere the
/// longest rest is kept, if it has 10 samples.
Repeats drop_repeats(RecordedSet& set);

}  // namespace saca::recordings
