"""LightGBM on windows: see run.sh."""
import argparse
import json
import pathlib
import sys
import time

import lightgbm
import numpy

import files
import sealed
import windows

AHEAD = (0, 5, 10)  # frames: the heads of saca/learn/score.h
MOST_ROUNDS, PATIENCE = 400, 25
TUNED_WITH = 8  # one group in so many stops the training early
# A class counts as much as its share to the power of -1/2: between "each frame alike", which forgets what is rare, and
# "each class alike", which calls it too often.
WEIGHT_POWER = -0.5
SETTINGS = {"objective": "multiclass", "num_class": files.CLASSES, "learning_rate": 0.1, "num_leaves": 31, "max_bin": 63,
            "min_data_in_leaf": 40, "feature_fraction": 0.7, "bagging_fraction": 0.8, "bagging_freq": 1, "lambda_l2": 1.0,
            "seed": 1, "deterministic": True, "force_row_wise": True, "num_threads": 2, "verbosity": -1}


def of_split(sequences, split):
    found = [one for one in sequences if one.split == split]
    if not found:
        raise sealed.Refused(f"want sequences of the split {split}, got none; there are "
                             f"{', '.join(sorted({one.split for one in sequences}))}")
    return found


def examples(sequences, told, ahead):
    """Windows and the labels `ahead` frames later, where both frames are scored."""
    rows, labels = [], []
    for one in sequences:
        size = len(one.labels) - ahead
        if size > 0:
            keep = one.scored[:size] & one.scored[ahead:]
            rows.append(told[one.name][:size][keep])
            labels.append(one.labels[ahead:][keep])
    return numpy.concatenate(rows), numpy.concatenate(labels)


def class_weights(labels):
    counts = numpy.bincount(labels, minlength=files.CLASSES).astype(float)
    weights = numpy.where(counts > 0, (numpy.maximum(counts, 1.0) / counts.sum()) ** WEIGHT_POWER, 0.0)
    return weights[labels] / weights[labels].mean()


def trained(train, tune, told, names, ahead, rounds):
    rows, labels = examples(train, told, ahead)
    data = lightgbm.Dataset(rows, labels, weight=class_weights(labels), feature_name=names)
    held_rows, held_labels = examples(tune, told, ahead)
    held = lightgbm.Dataset(held_rows, held_labels, reference=data, feature_name=names)
    scores = {}
    model = lightgbm.train(SETTINGS, data, rounds, valid_sets=[held], valid_names=["tune"],
                           callbacks=[lightgbm.early_stopping(PATIENCE, verbose=False),
                                      lightgbm.record_evaluation(scores)])
    return model, {"frames_ahead": ahead, "rounds": model.best_iteration, "windows": len(rows),
                   "tune_log_loss": min(scores["tune"]["multi_logloss"])}


def train(arguments):
    sequences = files.read_sequences(arguments.sequences)
    parts = of_split(sequences, "train"), of_split(sequences, "tune")
    begun = time.monotonic()
    told, names = {}, []
    for one in parts[0] + parts[1]:
        names, told[one.name] = windows.features(one.columns)
    arguments.models.mkdir(parents=True, exist_ok=True)
    heads = []
    for ahead in AHEAD:
        model, figures = trained(*parts, told, names, ahead, arguments.rounds)
        model.save_model(arguments.models / f"ahead{ahead}.txt", num_iteration=model.best_iteration)
        heads.append(figures)
    return {"heads": heads, "seconds": time.monotonic() - begun}


def foretell(arguments):
    sequences = of_split(files.read_sequences(arguments.sequences), arguments.split)
    told = numpy.concatenate([windows.features(one.columns)[1] for one in sequences])
    probabilities = []
    for ahead in AHEAD:
        path = arguments.models / f"ahead{ahead}.txt"
        if not path.is_file():
            raise sealed.Refused(f"{path}: want a model, got none; train first")
        raw = lightgbm.Booster(model_file=str(path)).predict(told, num_threads=SETTINGS["num_threads"])
        probabilities.append(raw / raw.sum(axis=1, keepdims=True))
    files.write_forecasts(arguments.forecasts, f"LightGBM {lightgbm.__version__} on windows of 2 s",
                          [one.name for one in sequences], [len(one.labels) for one in sequences], probabilities)
    return {"sequences": len(sequences), "frames": len(told)}


def one_in(sequences, share):
    """Every so many'th group, in alphabetic order, and all other sequences."""
    chosen = set(sorted({one.group for one in sequences})[::share])
    return ([one for one in sequences if one.group in chosen], [one for one in sequences if one.group not in chosen])


def cross(arguments):
    """Each split but `simulated` and `test` is foretold by trees that have not seen it: as saca-train's models do."""
    sequences = files.read_sequences(arguments.sequences)
    begun = time.monotonic()
    names, told = [], {}
    for one in sequences:
        if one.split != "test":
            names, told[one.name] = windows.features(one.columns)
    recorded = [one for one in sequences if one.split not in ("simulated", "test")]
    simulated = [one for one in sequences if one.split == "simulated"]
    order, probabilities = [], [[] for _ in AHEAD]
    for split in sorted({one.split for one in recorded}):
        tune, train_with = one_in([one for one in recorded if one.split != split], TUNED_WITH)
        unseen = of_split(sequences, split)
        order += unseen
        rows = numpy.concatenate([told[one.name] for one in unseen])
        for head, ahead in enumerate(AHEAD):
            model, figures = trained(train_with + simulated, tune, told, names, ahead, arguments.rounds)
            probabilities[head].append(model.predict(rows, num_iteration=model.best_iteration,
                                                     num_threads=SETTINGS["num_threads"]))
            print(f"{split}, {ahead} frames ahead: {figures['rounds']} rounds", file=sys.stderr)
    of_heads = [numpy.concatenate(some) for some in probabilities]
    files.write_forecasts(arguments.forecasts, f"LightGBM {lightgbm.__version__} on windows of 2 s",
                          [one.name for one in order], [len(one.labels) for one in order],
                          [head / head.sum(axis=1, keepdims=True) for head in of_heads])
    return {"sequences": len(order), "seconds": time.monotonic() - begun}


def main():
    parser = argparse.ArgumentParser(prog="intention_trees")
    actions = parser.add_subparsers(dest="what", required=True)
    for name, action in (("train", train), ("foretell", foretell), ("cross", cross)):
        command = actions.add_parser(name)
        command.set_defaults(action=action)
        command.add_argument("sequences", type=pathlib.Path)
        if name != "cross":
            command.add_argument("models", type=pathlib.Path)
        if name != "train":
            command.add_argument("forecasts", type=pathlib.Path)
        if name == "foretell":
            command.add_argument("--split", default="test")
        else:
            command.add_argument("--rounds", type=int, default=MOST_ROUNDS, help="at most")
        command.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    try:
        figures = arguments.action(arguments)
    except sealed.Refused as problem:
        sys.exit(f"intention_trees: error: {problem}")
    if arguments.json:
        print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
