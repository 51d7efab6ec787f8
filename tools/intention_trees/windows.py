"""What trees are told at each frame: values now, and means and slopes over the last 0.3 to 2 s. Nothing of later frames."""
import numpy

STEP = 0.1  # from frame to frame [s]
WINDOWS = (3, 5, 10, 20)  # frames: 0.3, 0.5, 1 and 2 s
FARTHEST = 150.0  # a gap, and nobody ahead [m]
SMOOTHED = ("speed", "acceleration", "yaw_rate", "lateral_speed", "heading", "gap", "gap_speed", "steering", "throttle",
            "brake")


def unwrapped(offset, width):
    """Way to the left since the first frame [m]: a jump of the offset by about a lane's width is a change of lane, not
    of place. NaN where there is no lane; a gap without a lane makes no step."""
    place = numpy.full(len(offset), numpy.nan)
    total, last = 0.0, None
    for frame, (now, lane) in enumerate(zip(offset, width)):
        if numpy.isnan(now):
            continue
        if last is not None:
            step = now - last
            lane = 3.5 if numpy.isnan(lane) else lane
            total += step - lane * numpy.round(step / lane)
        place[frame] = total
        last = now
    return place


def means_and_slopes(values, window):
    """Over the last frames that are known, `window` at most, this one included: the mean (NaN: none is known), and the
    slope of the line that fits them best [1/s] (NaN: fewer than two are)."""
    frames = len(values)
    known = ~numpy.isnan(values)
    time = STEP * numpy.arange(frames)
    filled = numpy.where(known, values, 0.0)

    def last(series):
        total = numpy.concatenate([[0.0], numpy.cumsum(series)])
        begin = numpy.maximum(numpy.arange(frames) + 1 - window, 0)
        return total[1:] - total[begin]

    count = last(known.astype(float))
    some = numpy.maximum(count, 1.0)
    mean_value, mean_time = last(filled) / some, last(time * known) / some
    spread = last(time * time * known) - some * mean_time * mean_time
    common = last(time * filled) - some * mean_time * mean_value
    with numpy.errstate(divide="ignore", invalid="ignore"):
        slope = numpy.where(spread > 1e-6, common / spread, numpy.nan)
    return numpy.where(count >= 1.0, mean_value, numpy.nan), numpy.where(count >= 2.0, slope, numpy.nan)


def way_within(place, window):
    """From the earliest known place of the window to the one now."""
    way = numpy.full(len(place), numpy.nan)
    for frame in range(len(place)):
        part = place[max(0, frame + 1 - window):frame + 1]
        known = part[~numpy.isnan(part)]
        if not numpy.isnan(place[frame]) and len(known) > 1:
            way[frame] = known[-1] - known[0]
    return way


def signals(columns):
    short = {name.rsplit("_", 1)[0] if name not in ("throttle", "brake") else name: values
             for name, values in columns.items()}
    gap = numpy.minimum(short["gap"], FARTHEST)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        time_gap = numpy.where(short["speed"] > 0.5, gap / short["speed"], numpy.nan)
        meets_in = numpy.where(short["gap_speed"] < -0.1, gap / -short["gap_speed"], numpy.nan)
    return {**short, "gap": gap, "alone": numpy.isinf(short["gap"]).astype(float), "time_gap": time_gap,
            "meets_in": numpy.minimum(meets_in, 20.0), "to_left": short["lane_width"] / 2 - short["offset"],
            "to_right": short["lane_width"] / 2 + short["offset"]}


def features(columns):
    """Names, and numbers for each frame.   (frames x names)"""
    now = signals(columns)
    told = dict(now)
    place = unwrapped(now["offset"], now["lane_width"])
    for window in WINDOWS:
        for name in SMOOTHED:
            told[f"{name}.mean{window}"], told[f"{name}.slope{window}"] = means_and_slopes(now[name], window)
        told[f"place.slope{window}"] = means_and_slopes(place, window)[1]
        told[f"way{window}"] = way_within(place, window)
    return list(told), numpy.column_stack(list(told.values()))
