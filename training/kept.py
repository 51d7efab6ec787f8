"""What a kept training was made of, and that another one does not go on with it."""
import hashlib
import pathlib

from examples import Problem

OF_SETS = ("system.txt", "train.jsonl", "calibration.jsonl")


def sha256_of(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def contents(folders, files):
    """sha256 by path: of what is read of the folders of sets, and of these files."""
    paths = [folder / name for folder in folders for name in OF_SETS] + list(files)
    return {str(path): sha256_of(path) for path in paths}


def by_last_parts(contents):
    """The same by the last parts of the paths: by two, or by as many as tell them apart."""
    count = 2
    shortened = lambda: {"/".join(pathlib.Path(path).parts[-count:]): digest for path, digest in contents.items()}
    while len(shortened()) < len(contents):
        count += 1
    return shortened()


def refuse_other(place, told, own):
    """Raises Problem, naming what differs between what a kept training tells of itself and this one. Each is settings
    and contents, by name; a training of before contents were kept tells none.
    """
    differ = sorted(key for key in told.keys() | own.keys() if told.get(key) != own.get(key))
    if differ:
        raise Problem(f"{place}: is of other settings or of files with other contents ({', '.join(differ)}); "
                      "choose another folder, or remove it to begin anew")
