"""Files whose first 512 bytes tell format, size and check sum of the rest (saca/base/formats/checksummed_file.h)."""
import pathlib

HEAD = 512
BASIS, PRIME, WORD = 14695981039346656037, 1099511628211, (1 << 64) - 1


class Refused(Exception):
    """What is wrong with a file, in one line."""


def fnv1a(data):
    """64 bits. Fowler, Noll, Vo."""
    total = BASIS
    for byte in data:
        total = (total ^ byte) * PRIME & WORD
    return total


def head(form, body):
    return f"{form}\nbytes {len(body)}\nfnv1a {fnv1a(body):016x}\n".encode("ascii").ljust(HEAD, b"\0")


def check(path, form):
    """Refuses a file of another format, or one that is cut off. The check sum is left to the program that scores."""
    try:
        with open(path, "rb") as file:
            lines = file.read(HEAD).split(b"\n")
    except OSError as problem:
        raise Refused(f"{path}: {problem.strerror}") from None
    if lines[0] != form.encode("ascii"):
        raise Refused(f"{path}: want a file of {form}, got {lines[0][:40].decode('ascii', 'replace') or 'nothing'}")
    size = pathlib.Path(path).stat().st_size - HEAD
    if len(lines) < 2 or lines[1] != f"bytes {size}".encode("ascii"):
        raise Refused(f"{path}: want as many bytes as its head says, got {size}: it is cut off")


def seal(path, form):
    """Writes the head of a file whose first 512 bytes are free (an HDF5 user block)."""
    data = pathlib.Path(path).read_bytes()
    with open(path, "r+b") as file:
        file.write(head(form, data[HEAD:]))
