#pragma once

#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/report/value_json.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::reach_study {

/// How far to look closer at the plane of a view, so that its danger can be seen: in [1, 8]. The
/// view's own zoom is not read.
/// @param solved  over two axes at least
[[nodiscard]] double zoom_on_danger(const danger::Solution& solved, const report::ValueView& view);

/// The view as a picture: the values over the plane, the zero level, the obstacle, the course.
/// @param solved  over two axes at least
/// @return  bytes of a PNG file; an error when there is no memory for it
[[nodiscard]] Result<std::string> value_picture(const danger::Solution& solved,
                                                const report::ValueView& view);

}  // namespace saca::reach_study
