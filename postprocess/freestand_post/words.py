"""Names, symbols, units and numbers as a reader wants to see them."""
import math

# name in the files -> what it is, for captions. Anything else is shown under its own name.
DEMANDS = {
    "delta": "dimensionless peak slip Δ = U ω²/PTA",
    "peak_slip": "largest slip U",
    "residual_slip": "slip that remains",
    "slid_path": "path slid S",
    "peak_rotation_over_alpha": "peak rotation over slenderness θ/α",
    "impacts": "number of impacts",
    "peak_acceleration": "peak equipment acceleration PEA",
    "peak_acceleration_at_height": "peak acceleration at the chosen height",
    "largest_blow": "largest jump of velocity in a blow, at the chosen height",
    "peak_contact_horizontal_over_weight": "largest force along the floor over the weight F_x/W",
    "peak_contact_vertical_over_weight": "largest force on the floor over the weight F_y/W",
    "peak_chain_force": "largest pull of a chain P",
}
# name in the files -> symbol.
# name in the files -> what specimens do beyond a capacity, for titles.
BEYOND = {
    "delta": "exceed Δ\u00a0=\u00a0{}",
    "peak_slip": "slip more than {}",
    "residual_slip": "end more than {} away",
    "slid_path": "slide a path longer than {}",
    "peak_rotation_over_alpha": "rock beyond {} of their slenderness",
    "impacts": "take more than {} impacts",
    "peak_acceleration": "feel more than {}",
    "peak_acceleration_at_height": "feel more than {} at the chosen height",
    "largest_blow": "take a blow of more than {}",
    "peak_contact_horizontal_over_weight": "push the floor sideways by more than {} of their weight",
    "peak_contact_vertical_over_weight": "press on the floor by more than {} of their weight",
    "peak_chain_force": "pull at a chain by more than {}",
}
# name in the files -> what happens, for titles, of demands that happen or not.
HAPPENINGS = {
    "connection_failed": "the connection fails",
    "wall_hit": "the block strikes the wall",
}
INTENSITIES = {"report": "PTA/(μg)\u00a0−\u00a01", "housner_m": "Housner's SI", "arias_mps": "Arias intensity", "pga_over_g_tan_alpha": "PGA/(g\u00a0tan\u00a0α)",
               "p_pgv_over_g_tan_alpha": "p\u00a0PGV/(g\u00a0tan\u00a0α)"}
DRAWS = {
    "friction_mu": "friction coefficient μ",
    "friction_mu_k": "friction coefficient μk",
    "friction_mu_s": "static friction μs",
    "block_width_m": "width (m)",
    "block_height_m": "height (m)",
    "block_mass_kg": "mass (kg)",
    "block_slenderness": "slenderness",
    "block_alpha_rad": "slenderness α (rad)",
    "block_size_m": "size R (m)",
    "pulse_period_s": "pulse period (s)",
    "motion_pulse_period_s": "period of the motion's pulse (s)",
    "pta_g": "peak acceleration PTA (g)",
    "pta": "peak acceleration PTA",
    "scale": "scale factor",
    "motion": "motion",
}
UNIT_SUFFIXES = ("mps2", "radps", "mps", "rad", "kgm2", "kg", "g", "m", "s", "hz", "npm", "nspm", "n")
UNITS = {"mps2": "m/s²", "radps": "rad/s", "mps": "m/s", "m/s2": "m/s²", "hz": "Hz", "kgm2": "kg m²", "npm": "N/m", "nspm": "N s/m", "n": "N"}
MOTIONS = {"slide": "sliding", "rock": "rocking", "slide_rock": "slide-rock", "bouc_wen": "sliding"}  # of a block, by the model
OUTCOMES = {
    "at_rest": "stayed at rest",
    "moved": "moved and stood",
    "overturned": "overturned",
    "painleve": "Painlevé's paradox",
    "step_limit": "step limit",
    "not_finite": "not finite",
}

def split_unit(name):
    """"width_m" -> ("width", "m"); "rate_per_s" -> ("rate", "1/s"); "mu_k" -> ("mu_k", "")."""
    stem, _, last = name.rpartition("_")
    if stem.endswith("_per") and last in UNIT_SUFFIXES:
        return stem.removesuffix("_per"), f"1/{UNITS.get(last, last)}"
    return (stem, UNITS.get(last, last)) if stem and last in UNIT_SUFFIXES else (name, "")


def with_unit(text, unit):
    return text if unit in ("", "1") else f"{text} ({UNITS.get(unit, unit)})"


def demand(name, symbol=""):
    """Symbol of a demand parameter: the one in the file, or the name without its unit."""
    return symbol or split_unit(name)[0].replace("_", " ")


def demand_meaning(name):
    stem = split_unit(name)[0]
    return DEMANDS.get(name, DEMANDS.get(stem, stem.replace("_", " ")))


def beyond(name, symbol, capacity):
    """"slip more than 0.4 m": what specimens do whose demand exceeds a capacity (given as text)."""
    stem = split_unit(name)[0]
    return (BEYOND.get(name) or BEYOND.get(stem) or symbol.join(("exceed ", "\u00a0=\u00a0{}"))).format(capacity)


def happening(name):
    """"the connection fails": what happens or not."""
    return HAPPENINGS.get(name, name.replace("_", " "))


def intensity(name, symbol=""):
    """Symbol of an intensity measure: "pga_g", "sa_g:0.5"."""
    if name.startswith("ground.") and not symbol:
        return "ground " + intensity(name.removeprefix("ground."))
    name, _, period = name.partition(":")
    if period:
        return f"Sa({period}\u00a0s)"
    stem = split_unit(name)[0]
    return symbol or INTENSITIES.get(name) or (stem.upper() if len(stem) < 4 else stem.replace("_", " "))


SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def column(name):
    """Axis label of a draw."""
    if name in DRAWS:
        return DRAWS[name]
    stem, unit = split_unit(name)
    return with_unit(stem.removeprefix("effects_").replace("_", " "), unit)


def short_column(name):
    """The same without its unit, for sentences."""
    return column(name).split(" (")[0]


def number(value, digits=2):
    """Significant digits, no exponent where it can be avoided, true minus sign."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    magnitude = math.floor(math.log10(abs(value)))
    if magnitude >= 6 or magnitude < -4:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return mantissa.replace("-", "−") + "×10" + str(int(exponent)).translate(SUPERSCRIPT)
    decimals = max(0, digits - 1 - magnitude)
    text = f"{value:.{decimals}f}"
    return text.replace("-", "−")


def percent(share):
    return "0 %" if share == 0 else "< 0.1 %" if share < 0.001 else f"{100 * share:.0f} %" if share > 0.0995 else f"{100 * share:.1f} %"


def level(confidence):
    """"95 %": of an interval."""
    return f"{100 * confidence:.4g} %"


def plain(value):
    """A number somebody chose (a capacity, an edge): no trailing zeros."""
    return "–" if value is None or not math.isfinite(value) else f"{value:.4g}".replace("-", "−")


def span(low, high):
    """The two ends of a range, to about a hundredth of its width."""
    decimals = max(0, 1 - math.floor(math.log10(high - low))) if high > low else 2

    def text(value):
        shown = f"{value:.{decimals}f}"
        shown = shown.rstrip("0").rstrip(".") if "." in shown else shown
        return "0" if shown in ("-0", "") else shown.replace("-", "−")
    return f"{text(low)} to {text(high)}"


def plus_minus(value, error):
    """As many decimals as the standard error has meaning."""
    if not (math.isfinite(value) and math.isfinite(error) and error > 0):
        return number(value, 3)
    decimals = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{decimals}f} ± {error:.{decimals}f}".replace("-", "−")


def share(value, error):
    """A share of a whole and its standard error: two decimals, three where the error has meaning there."""
    if not math.isfinite(value):
        return "–"
    if max(abs(value), 0 if math.isnan(error) else error) < 0.0005:
        return "0" if value == 0 else "< 0.001" if value > 0 else "> −0.001"
    decimals = 3 if error < 0.0095 else 2
    return f"{value:.{decimals}f} ± {error:.{decimals}f}".replace("-", "−")


def probability(value):
    """Two decimals; never 0 or 1 unless it is."""
    if value is None or not math.isfinite(value):
        return "–"
    if 0 < value < 0.005:
        return "< 0.01"
    if 0.995 < value < 1:
        return "> 0.99"
    return f"{value:.2f}"


def p_value(value):
    if value is None or not math.isfinite(value):
        return "–"
    if value < 0.0005:
        return "< 0.001"
    return f"{value:.3f}" if value < 0.1 else f"{value:.2f}"


def equals(text):
    """"0.31" -> "= 0.31", "< 0.001" stays."""
    return text if text[:1] in "<>" else f"= {text}"


def count(value):
    return f"{int(value):,}".replace(",", "\u202f")


def plural(n, noun):
    return f"{count(n)} {noun}" + ("" if n == 1 else "s")


def listing(items, last="and"):
    items = list(items)
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + f" {last} " + items[-1] if items else ""


def fixed(value, decimals):
    return f"{value:.{decimals}f}".replace("-", "−") if math.isfinite(value) else "–"


def is_(left, value, unit=""):
    """"left = value unit" that no line break parts."""
    return f"{left}\u00a0=\u00a0{quantity(value, unit)}"


def quantity(value, unit=""):
    """A computed value: two digits and its unit."""
    return number(value) + spaced(unit)


def chosen(value, unit=""):
    """A value somebody chose: as it is, and its unit."""
    return plain(value) + spaced(unit)


def spaced(unit):
    return "" if unit in ("", "1") else f"\u00a0{UNITS.get(unit, unit)}"


def capitalised(text):
    return text[:1].upper() + text[1:]


# name in the study -> what it is, where the name of its column would not do.
SAMPLED = {
    "motion": "which motion",
    "motion.amplitude": "strength of the motion",
    "motion.period_s": "pulse period",
    "motion.peak_acceleration_g": "peak acceleration",
    "motion.peak_velocity_mps": "peak velocity",
    "motion.pta_g": "peak acceleration",
    "motion.scale": "scale of the motion",
    "friction.static_ratio": "static over kinetic friction",
    "impact.factor": "factor of the impact law",
}


def sampled(name):
    """"friction coefficient μk": a number of a study, by its dotted name."""
    return SAMPLED.get(name) or short_column(name.replace(".", "_")).removeprefix("block ")


def property_of_motions(name):
    """"the period of the pulse", "record magnitude mw": a column of the table of records, as ranking.csv has it."""
    return {"record_pulse_period_s": "the period of the pulse", "record_building_period_s": "the period of the building",
            "record_building_damping": "the damping of the building"}.get(name, name.replace("_", " "))


def a_year(rate):
    """"2.3×10⁻⁴": two digits, as powers of ten below a hundredth."""
    if not math.isfinite(rate) or rate == 0 or rate >= 0.01:
        return number(rate)
    mantissa, exponent = f"{rate:.1e}".split("e")
    return mantissa + "×10" + str(int(exponent)).translate(SUPERSCRIPT)
