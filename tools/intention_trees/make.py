"""LightGBM on windows: see run.sh."""
import argparse
import hashlib
import json
import pathlib
import sys
import time

import lightgbm
import numpy

import files
import sealed
import windows

AHEAD = (0, 5, 10)  # frames: the heads of saca/lab/intention_scoring/score.h
MOST_ROUNDS, PATIENCE = 400, 25
STOPPED_BY = 8  # one group in so many is not learnt from, but stops the training
# A class counts as much as its share to the power of -1/2: between "each frame alike", which forgets what is rare, and
# "each class alike", which calls it too often.
WEIGHT_POWER = -0.5
THINNED = 3  # neighbouring windows of one who maintains are nearly the same
MODEL = f"LightGBM {lightgbm.__version__} on windows of 2 s"
SETTINGS = {"objective": "multiclass", "num_class": files.CLASSES, "learning_rate": 0.1, "num_leaves": 31, "max_bin": 63,
            "min_data_in_leaf": 40, "feature_fraction": 0.7, "bagging_fraction": 0.8, "bagging_freq": 1, "lambda_l2": 1.0,
            "seed": 1, "deterministic": True, "force_row_wise": True, "num_threads": 2, "verbosity": -1}
TEACHING = SETTINGS | {"learning_rate": 0.2}  # half as many rounds, of which twenty models need many


def of_split(sequences, split):
    found = [one for one in sequences if one.split == split]
    if not found:
        raise sealed.Refused(f"want sequences of the split {split}, got none; there are "
                             f"{', '.join(sorted({one.split for one in sequences}))}")
    return found


def examples(sequences, told, ahead, thinned=1):
    """Windows and the labels `ahead` frames later, where both frames are scored; of those that maintain before and
    after only each so manieth. And how many each stands for."""
    rows, labels, stand_for = [], [], []
    for one in sequences:
        size = len(one.labels) - ahead
        if size > 0:
            before, after = one.labels[:size], one.labels[ahead:]
            usual = (before == 0) & (after == 0)
            kept = one.scored[:size] & one.scored[ahead:] & (~usual | (numpy.arange(size) % thinned == 0))
            rows.append(told[one.name][:size][kept])
            labels.append(after[kept])
            stand_for.append(numpy.where(usual, thinned, 1)[kept])
    return numpy.concatenate(rows), numpy.concatenate(labels), numpy.concatenate(stand_for).astype(float)


def class_weights(labels, stand_for):
    counts = numpy.bincount(labels, weights=stand_for, minlength=files.CLASSES)
    weights = numpy.where(counts > 0, (numpy.maximum(counts, 1.0) / counts.sum()) ** WEIGHT_POWER, 0.0)
    each = weights[labels] * stand_for
    return each / each.mean()


def trained(train, tune, told, names, ahead, rounds, settings):
    rows, labels, stand_for = examples(train, told, ahead, THINNED)
    data = lightgbm.Dataset(rows, labels, weight=class_weights(labels, stand_for), feature_name=names)
    held_rows, held_labels, _ = examples(tune, told, ahead)
    held = lightgbm.Dataset(held_rows, held_labels, reference=data, feature_name=names)
    scores = {}
    model = lightgbm.train(settings, data, rounds, valid_sets=[held], valid_names=["tune"],
                           callbacks=[lightgbm.early_stopping(PATIENCE, verbose=False),
                                      lightgbm.record_evaluation(scores)])
    return model, {"frames_ahead": ahead, "rounds": model.best_iteration, "windows": len(rows),
                   "tune_log_loss": min(scores["tune"]["multi_logloss"])}


def heads_of(train, tune, told, names, rounds, settings=SETTINGS):
    return [trained(train, tune, told, names, ahead, rounds, settings) for ahead in AHEAD]


def windows_of(sequences):
    told, names = {}, []
    for one in sequences:
        names, told[one.name] = windows.features(one.columns)
    return told, names


def probabilities_of(models, told):
    found = []
    for model in models:
        raw = model.predict(told, num_iteration=model.best_iteration or None, num_threads=SETTINGS["num_threads"])
        found.append(raw / raw.sum(axis=1, keepdims=True))
    return numpy.stack(found)


def written(path, sequences, probabilities, model=MODEL):
    files.write_forecasts(path, model, [one.name for one in sequences],
                          [len(one.labels) for one in sequences], probabilities)
    return {"sequences": len(sequences), "frames": sum(len(one.labels) for one in sequences)}


def train(arguments):
    sequences = files.read_sequences(arguments.sequences)
    parts = of_split(sequences, "train"), of_split(sequences, "tune")
    begun = time.monotonic()
    told, names = windows_of(parts[0] + parts[1])
    arguments.models.mkdir(parents=True, exist_ok=True)
    heads = heads_of(*parts, told, names, arguments.rounds)
    for model, figures in heads:
        model.save_model(arguments.models / f"ahead{figures['frames_ahead']}.txt", num_iteration=model.best_iteration)
    return {"heads": [figures for _, figures in heads], "seconds": time.monotonic() - begun}


def predict(arguments):
    sequences = of_split(files.read_sequences(arguments.sequences), arguments.split)
    models = []
    for ahead in AHEAD:
        path = arguments.models / f"ahead{ahead}.txt"
        if not path.is_file():
            raise sealed.Refused(f"{path}: want a model, got none; train first")
        models.append(lightgbm.Booster(model_file=str(path)))
    told, _ = windows_of(sequences)
    return written(arguments.forecasts, sequences, probabilities_of(models, numpy.concatenate(list(told.values()))))


def parts_of(sequences, word):
    parts = sorted({one.split for one in sequences if one.split.startswith(word)})
    if len(parts) < 3:
        raise sealed.Refused(f"want three splits or more that begin with {word}, got {len(parts)}")
    return parts


def is_of(one, places):
    return one.split in places or one.site in places


def heads_without(places, sequences, parts, told, names, rounds, settings=SETTINGS):
    """They learn from what is of no such split or site, but for a few groups, which stop them."""
    seen = [one for one in sequences if not is_of(one, places)]
    always = [one for one in seen if one.split in ("train", "simulated")]
    others = [one for one in seen if one.split in parts]
    stopping = set(sorted({one.group for one in others})[::STOPPED_BY])
    return heads_of(always + [one for one in others if one.group not in stopping],
                    [one for one in others if one.group in stopping], told, names, rounds, settings)


def said_of(mine, heads, told):
    return probabilities_of([model for model, _ in heads], numpy.concatenate([told[one.name] for one in mine]))


def cross(arguments):
    """Each part by models that have not seen it."""
    sequences = files.read_sequences(arguments.sequences)
    parts = parts_of(sequences, arguments.parts)
    begun = time.monotonic()
    told, names = windows_of(sequences)
    foretold, found, figures = [], [], []
    for part in parts:
        heads = heads_without({part}, sequences, parts, told, names, arguments.rounds)
        mine = of_split(sequences, part)
        found.append(said_of(mine, heads, told))
        foretold += mine
        figures.append({"part": part, "heads": [one for _, one in heads]})
    return written(arguments.forecasts, foretold, numpy.concatenate(found, axis=1)) | {
        "parts": figures, "seconds": time.monotonic() - begun}


def teachers(arguments):
    """Whoever leaves out a part or a site may not learn of it through a teacher either: for each of them, every other
    part by models that have seen neither. Models of two parts serve both; what is there already is not made again."""
    sequences = files.read_sequences(arguments.sequences)
    parts = parts_of(sequences, arguments.parts)
    unknown = set(arguments.site) - {one.site for one in sequences}
    if unknown:
        raise sealed.Refused(f"--site: want sites of the file, got {', '.join(sorted(unknown))}; there are "
                             f"{', '.join(sorted({one.site for one in sequences}))}")
    begun = time.monotonic()
    told, names = windows_of(sequences)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    pairs = arguments.folder / "pairs"
    pairs.mkdir(exist_ok=True)
    sequences_sum = hashlib.sha256(arguments.sequences.read_bytes()).hexdigest()[:16]
    model = f"{MODEL}, at most {arguments.rounds} rounds of rate {TEACHING['learning_rate']}, sequences {sequences_sum}"

    def said_without(left_out, part):
        path = pairs / ("_".join(sorted((left_out, part))) + ".h5")
        if not path.exists():
            places = {left_out, part}
            heads = heads_without(places, sequences, parts, told, names, arguments.rounds, TEACHING)
            both = [one for one in sequences if one.split in places]
            written(path, both, said_of(both, heads, told), model)
            print(f"{path.name}: {time.monotonic() - begun:.0f} s", file=sys.stderr, flush=True)
        made_by, said = files.read_forecasts(path)
        if made_by != model:
            raise sealed.Refused(f"{path}: want forecasts by {model}, got those by {made_by}: remove {pairs} to begin anew")
        return said

    for left_out in parts + arguments.site:
        mine, found = [], []
        for part in parts:
            if part != left_out:
                said = said_without(left_out, part)
                taught = [one for one in of_split(sequences, part) if one.site != left_out]
                found += [said[one.name] for one in taught]
                mine += taught
        written(arguments.folder / f"without_{left_out.replace('-', '_')}.h5", mine, numpy.concatenate(found, axis=1))
    return {"left_out": parts + arguments.site, "seconds": time.monotonic() - begun}


def command(actions, name, action, *places):
    parser = actions.add_parser(name)
    parser.set_defaults(action=action)
    for place in places:
        parser.add_argument(place, type=pathlib.Path)
    if action != predict:
        parser.add_argument("--rounds", type=int, default=MOST_ROUNDS, help="at most")
    parser.add_argument("--json", action="store_true")
    return parser


def main():
    parser = argparse.ArgumentParser(prog="intention_trees")
    actions = parser.add_subparsers(dest="what", required=True)
    command(actions, "train", train, "sequences", "models")
    command(actions, "predict", predict, "sequences", "models", "forecasts").add_argument("--split", default="test")
    command(actions, "cross", cross, "sequences", "forecasts").add_argument("--parts", default="part-")
    for_teachers = command(actions, "teachers", teachers, "sequences", "folder")
    for_teachers.add_argument("--parts", default="part-")
    for_teachers.add_argument("--site", action="append", default=[])
    arguments = parser.parse_args()
    try:
        figures = arguments.action(arguments)
    except sealed.Refused as problem:
        sys.exit(f"intention_trees: error: {problem}")
    if arguments.json:
        print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
