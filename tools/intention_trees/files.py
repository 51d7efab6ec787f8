"""Reads saca.sequences/1, writes saca.forecasts/1 (docs/formats.md)."""
import os

import h5py
import numpy

import sealed

SEQUENCES, FORECASTS = "saca.sequences/1", "saca.forecasts/1"
CLASSES = 6
COLUMNS = ("speed_mps", "acceleration_mps2", "yaw_rate_radps", "offset_m", "lateral_speed_mps", "heading_rad",
           "lane_width_m", "gap_m", "gap_speed_mps", "steering_rad", "throttle", "brake")


class Sequence:
    """One road user: columns by name, labels, and whether each frame is scored."""

    def __init__(self, name, site, group, split, columns, labels, scored):
        self.name, self.site, self.group, self.split = name, site, group, split
        self.columns, self.labels, self.scored = columns, labels, scored


def lines(data):
    return data[()].decode("utf-8").splitlines()


def read_sequences(path):
    sealed.check(path, SEQUENCES)
    with h5py.File(path, "r") as file:
        names, splits = lines(file["sequences/names"]), lines(file["sequences/splits"])
        groups, sites = lines(file["sequences/groups"]), lines(file["sequences/sites"])
        ends = numpy.cumsum(file["sequences/num_frames"][:]).astype(int)
        columns = {name: file[f"frames/{name}"][:] for name in COLUMNS}
        labels, scored = file["frames/label"][:].astype(int), file["frames/scored"][:] == 1.0
    if not len(names) == len(groups) == len(sites) == len(splits) == len(ends) or ends[-1] != len(labels):
        raise sealed.Refused(f"{path}: want names, splits and frames of as many sequences, got {len(names)}, "
                             f"{len(splits)} and {len(ends)}")
    found = []
    begins = numpy.concatenate([[0], ends[:-1]])
    for name, site, group, split, begin, end in zip(names, sites, groups, splits, begins, ends):
        found.append(Sequence(name, site, group, split, {key: values[begin:end] for key, values in columns.items()},
                              labels[begin:end], scored[begin:end]))
    return found


def read_forecasts(path):
    """Who made them, and what is predicted of each sequence, by name: (heads x frames x classes)."""
    sealed.check(path, FORECASTS)
    with h5py.File(path, "r") as file:
        model = file["model"][()].decode("utf-8")
        names, ends = lines(file["names"]), numpy.cumsum(file["num_frames"][:]).astype(int)
        probabilities = file["probabilities"][:]
    return model, dict(zip(names, numpy.split(probabilities, ends[:-1], axis=1)))


def write_forecasts(path, model, names, num_frames, probabilities):
    """probabilities: (heads x frames x classes), the sequences' frames one after another."""
    part = f"{path}.part"
    with h5py.File(part, "w", userblock_size=sealed.HEAD) as file:
        file.attrs["format"] = numpy.bytes_(FORECASTS)
        file["model"] = numpy.bytes_(model.encode("utf-8"))
        file["names"] = numpy.bytes_("".join(name + "\n" for name in names).encode("utf-8"))
        file["num_frames"] = numpy.asarray(num_frames, float)
        file["probabilities"] = numpy.asarray(probabilities, float)
    sealed.seal(part, FORECASTS)
    os.replace(part, path)  # in one step
