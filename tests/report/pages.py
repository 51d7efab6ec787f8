"""What the tests of both pages ask of a page and of a record."""

import pathlib

FORMATS = pathlib.Path(__file__).parents[2] / "docs" / "formats.md"
HOSTILE = "<img src=x onerror='window.hit=1'><script>window.hit=1</script> \u2028 </script>"


def colour(page, name):
    """A colour of the theme as (r, g, b)."""
    text = page.run(f"getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()")
    return tuple(int(text[i:i + 2], 16) for i in (1, 3, 5))


def pixel(page, x, y):
    return page.pixels(round(x), round(y), 1, 1)[0][0]


def like(a, b, tolerance=3):
    return all(abs(p - q) <= tolerance for p, q in zip(a, b))


def luminance(rgb):
    """WCAG 2.1, relative luminance."""
    r, g, b = (v / 255 / 12.92 if v / 255 <= 0.03928 else ((v / 255 + 0.055) / 1.055) ** 2.4 for v in rgb)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def contrast(a, b):
    """WCAG 2.1, contrast ratio."""
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


def keys(value):
    """All keys anywhere in a record."""
    if isinstance(value, dict):
        return set(value) | {k for v in value.values() for k in keys(v)}
    return {k for v in value for k in keys(v)} if isinstance(value, list) else set()


def poisoned(value, spared):
    """The record with markup and script in each of its texts but those of the spared keys."""
    if isinstance(value, dict):
        return {k: v if k in spared else poisoned(v, spared) for k, v in value.items()}
    if isinstance(value, list):
        return [poisoned(v, spared) for v in value]
    return HOSTILE if isinstance(value, str) else value
