"""The texts of ``page.html``, marked for translation.

The page translates its texts itself. This list exists so that the extraction of texts finds them.
"""

from rotemina.sim.messages import marked

PAGE_TEXTS = (
    marked("gap", "en"),
    marked("gap", "Gap diagnosis of {robot}"),
    marked("gap", "Gap between model and machine: {robot}"),
    marked("gap", "Where"),
    marked("gap", "Which effect"),
    marked("gap", "How far it shrinks"),
    marked("gap", "Parameters"),
    marked("gap", "Remarks"),
    marked("gap", "Next experiment"),
    marked("gap", "Facts"),
    marked("gap", "axis"),
    marked("gap", "verdict"),
    marked("gap", "Where the gap lies"),
    marked(
        "gap",
        "Axes and channels whose gap certainly exceeds the noise floor. Shares are of the squared "
        "gap above the floors; intervals are 95 % intervals.",
    ),
    marked("gap", "channel"),
    marked("gap", "stage"),
    marked("gap", "gap, rms"),
    marked("gap", "noise floor"),
    marked("gap", "share"),
    marked("gap", "its interval"),
    marked("gap", "(gap² − floor²)/floor²"),
    marked("gap", "worst band"),
    marked("gap", "worst regime"),
    marked("gap", "No axis has a gap that certainly exceeds the noise floor."),
    marked("gap", "{axis} at {tap}, by band and regime"),
    marked("gap", "regime"),
    marked("gap", "share of the channel"),
    marked("gap", "{share} of the channel"),
    marked(
        "gap",
        "Rms of the model's gap within each band, in noise floors. Regimes overlap: forward "
        "motion is also fast or slow.",
    ),
    marked("gap", "Which effect causes it"),
    marked("gap", "effect"),
    marked("gap", "formulation"),
    marked("gap", "probability"),
    marked("gap", "indistinguishable from"),
    marked("gap", "gap without it"),
    marked("gap", "with it"),
    marked("gap", "closed"),
    marked("gap", "{effect} from {axis}"),
    marked(
        "gap", "Gaps are rms on data that the fit did not see; all other causes are in the model."
    ),
    marked("gap", "No effect is named."),
    marked("gap", "Candidates for {axis}"),
    marked("gap", "candidate"),
    marked("gap", "remainder on unseen data [noise floors]"),
    marked("gap", "How far the gap shrinks"),
    marked("gap", "{axis} at {tap}"),
    marked(
        "gap",
        "Rms of the gap on data that no fit saw: with the model as it is, with its own "
        "parameters re-tuned, and with one effect after another.",
    ),
    marked("gap", "raw"),
    marked("gap", "re-tuned"),
    marked("gap", "corrected"),
    marked("gap", "black-box model"),
    marked("gap", "with"),
    marked("gap", "on"),
    marked("gap", "remainder, rms"),
    marked("gap", "share of the closed gap (Shapley)"),
    marked(
        "gap",
        "Left: the gap before (grey) and after (blue) over time; the band is the noise floor. "
        "Middle: reading over command, real and models. Right: the gap over the command. Each "
        "model is shifted to the mean of its record: constant offsets are not judged.",
    ),
    marked(
        "gap",
        "From command to {tap} by Welch's method (H1), where the response is coherent; the band "
        "is the 95 % interval of the real one.",
    ),
    marked("gap", "parameter"),
    marked("gap", "value"),
    marked("gap", "95 % interval"),
    marked("gap", "SI"),
    marked("gap", "at a bound"),
    marked(
        "gap",
        "If a parameter is at a bound, the equations fit only in part. Where no interval is given, "
        "the data do not bound the value.",
    ),
    marked("gap", "No effect was fitted."),
    marked("gap", "Effects of the corrected model"),
    marked("gap", "parameters, SI"),
    marked("gap", "None."),
    marked("gap", "The reading as each rival, fitted to these records, predicts it."),
    marked("gap", "{tap} as each rival, fitted to these records, predicts it."),
    marked("gap", "No experiment is needed, or none was found that would give more information."),
    marked("gap", "Robot {robot}; axes"),
    marked("gap", "Effects in the model before: {count}. Seed {seed}; RoTeMiNa {version}."),
    marked("gap", "record"),
    marked("gap", "name"),
    marked("gap", "rows"),
    marked("gap", "duration"),
    marked("gap", "rate"),
    marked("gap", "channels"),
    marked("gap", "loop"),
    marked("gap", "history"),
    marked("gap", "fingerprint"),
    marked("gap", "Metadata of record {number}"),
)
