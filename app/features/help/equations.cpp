#include "app/features/help/equations.h"

#include <algorithm>

namespace faintline {

namespace {

    QString u(const char *text)
    {
        return QString::fromUtf8(text);
    }

    Equation make(const char *view, const char *title, const char *equation, const char *symbols, const char *source)
    {
        return {u(view), u(title), u(equation), u(symbols), u(source)};
    }

    const char *const smdEquation = "u(n, t) = λ(n, t) + max( ln K + maxₘ [ ln P(n|m) + u(m, t−1) ], 0 )\n"
                                    "D(t, f) = max over the slopes at f of u";

} // namespace

const std::vector<Equation> &equations()
{
    static const std::vector<Equation> all{
        make("input", "The input: power over noise",
             "S(t, f) = Σₙ w(n) · x(t·hop + n) · e^(−2πi f n),   Σ w² = 1\n"
             "y(t, f) = |S(t, f)|² / B(t, f),   shown as 10·lg y\n"
             "area SNR of a box = 10·lg [ 1/(T k_f) Σ ( y/N − 1 ) ]",
             "x  samples\n"
             "w  window of T_FT seconds\n"
             "hop  T_FT/k_t, bins T_FT⁻¹/k_f apart\n"
             "B  noise background: local mean noise power, so y has mean 1 on noise\n"
             "T, k_f  the box's frames, bins per cell\n"
             "N  mean y beside the box; the result is a line's SNR in one window",
             "Billon 2005, section 4; the background as in docs/theory.md"),
        make("output:smd", "The statistic of the sequential Markov detector", smdEquation,
             "n, m  states: bin and slope\n"
             "λ = ln p₁(y)/p₀(y)  evidence of the state's cell, nat\n"
             "P(n|m) = h(|b − a|)  from slope a to slope b\n"
             "ln K  bonus for continuing a path; a reset if 0 is larger",
             "Billon 2005, section 3; Parsons 2008, eq. 8"),
        make("output:pOfN", "The statistic of P out of N",
             "m(t, f) = largest y in the window's band about f\n"
             "D(t, f) = mean of the P largest m(t′, f), t−N < t′ ≤ t,\n"
             "if the P-th largest exceeds r₁ and the mean r₂; else 0",
             "y  power over noise\n"
             "P, N  frames needed, frames in the window\n"
             "r₁, r₂  thresholds on a frame and on the mean",
             "Billon 2005, sections 1 and 5"),
        make("output:integrator", "The statistic of the integrator",
             "boxcar:  D(t, f) = (1/n) Σ y(t′, f),  t−n < t′ ≤ t\n"
             "exponential:  D(t, f) = (1−a)·y(t, f) + a·D(t−1, f),  a = e^(−1/n)",
             "y  power over noise\n"
             "n  frames of the duration set",
             "Billon 2005, section 5"),
        make("output:energy", "The statistic of single-frame energy", "D(t, f) = y(t, f)", "y  power over noise",
             "one frame, no memory"),
        make("output:blockViterbi", "The statistic of fixed-window Viterbi",
             "u(n, t₀) = λ(n, t₀)\n"
             "u(n, t) = λ(n, t) + maxₘ [ ln P(n|m) + u(m, t−1) ],  t₀ < t < t₀ + B\n"
             "D = max over the slopes, at a block's end",
             "B  frames of a block; each block starts from zero\n"
             "λ, P  as for the sequential Markov detector",
             "Billon 2005, section 2"),
        make("output:shiryaevRoberts", "The statistic of Shiryaev and Roberts",
             "A(n, t) = e^λ(n, t) · ( K Σₘ P(n|m) A(m, t−1) + 1 )\n"
             "D(t, f) = max over the slopes at f of ln A",
             "A  sum over all paths, not the best alone\n"
             "λ, P, K  as for the sequential Markov detector",
             "the sum-product form of Billon 2005, section 3"),
        make("output:presence", "Presence of the tracks",
             "αₜ(s) = C · e^λ(s) · ( p/N · αₜ₋₁(off) + (1−p) Σₘ P(s|m) αₜ₋₁(m) ),   γ = α·β,   presence = 1 − γ(off)\n"
             "v(t, f) = max over the tracks of presence(t) · share of f's cell in the track's band",
             "s, m  states in a corridor about the track; off: no signal\n"
             "p  probability of an onset or an end, e^(−T/2), T threshold\n"
             "β  the same recursion, backward in time\n"
             "band  5 to 95 % of the position's law, Σ γ over the slopes",
             "Baum and others 1970; docs/theory.md, Refinement"),
        make("profile", "The statistic along time", "D(t, f) at the cursor's f",
             "D  as in the picture above, with the threshold", "the picture of the statistic"),
        make("regulation", "ln K and resets",
             "reset in t:  ln K + maxₘ [ ln P(n|m) + u(m, t−1) ] < 0\n"
             "calibrated:  K so that half of the states continue on noise\n"
             "mean:  K(t) = K₀ − mean of the continued scores",
             "the share is over all states that are not inhibited",
             "Billon 2005, section 3; Parsons 2008, eq. 8 and 10"),
        make("threshold", "False alarms against the threshold",
             "P(D > T) of a cell of noise, simulated;  far out  ~ e^(−θT)\n"
             "false alarms per hour = rate(T) · cells · frames per hour\n"
             "ln rate(T) = ln rate(u) − θ·(T − u)",
             "rate  events per cell and frame from the whole chain on simulated noise\n"
             "u  where events were counted, θ  fitted slope, 1/nat",
             "docs/theory.md, False alarms; Lindley's recursion for the tail"),
        make("why", "Path breakdown", "u = Σ over the path's steps of  λ + ln P + ln K",
             "from the latest reset on, in which u = λ\n"
             "margin = D − threshold\n"
             "a family's member brings  Σ λ(y of all) − λ(y of the others)",
             "Billon 2005, section 3"),
        make("events", "Events and tracks",
             "event: D(t, f) > T, clustered over neighbouring cells\n"
             "track: the same recursion without reset, on a small window",
             "T  threshold", "Parsons 2008, 2.3 and Figure 1; docs/theory.md, From statistic to tracks"),
        make("noise", "Calibration",
             "ln K by bisection, so that half of the states continue\n"
             "ln rate(T) = ln rate(u) − θ·(T − u)",
             "on simulated noise with the same window, overlap, model and detector", "Billon 2005, section 3"),
        make("noisefit", "Noise against its law", "P(y > t) = e^(−t),  mean 1",
             "y  power over noise background\n"
             "distance: the largest gap of the two laws (Kolmogorov, Smirnov)",
             "p₀ of Billon 2005, section 4"),
        make("spectrum", "Spectrum",
             "ȳ(f) = (1/n) Σ y(t, f)  over the visible part\n"
             "density = 2·|X(f)|²/f_s,  half of that for I/Q",
             "y  power over noise background\n"
             "X  transform in a window of unit energy, f_s sample rate; full scale is 1",
             "Welch 1967"),
        make("channels", "Channels beside each other", "y_c(t, f) = |S_c(t, f)|² / B_c(t, f),   shown as 10·lg y_c",
             "S_c  spectrogram of channel c, with the window of the analysis\n"
             "B_c  noise background of channel c, so y_c has mean 1 on noise\n"
             "without families of lines, and without subtracting strong lines",
             "Billon 2005, section 4; the background as in docs/theory.md"),
        make("doppler", "Doppler fit",
             "f(t) = f₀ / ( 1 + v²τ / (c·r(τ)) ),   r(τ) = √( R² + v²τ² )\n"
             "t = t₀ + τ + r(τ)/c,   Σ ( (fᵢ − f(tᵢ))/σᵢ )² least",
             "f₀  rest frequency, v  speed, R  closest range, t₀  its time at the source\n"
             "τ  when it was sent, from t₀ on, t  when it arrives\n"
             "c  speed of propagation, σᵢ  the track's own errors\n"
             "intervals by profile likelihood, 90 %",
             "Ferguson and Quinn 1994"),
        make("pd", "Detection probability",
             "Pd = (1/I²) Σᵢ Σⱼ [ D₁ᵢ > D₀ⱼ ]  per run, averaged over the runs\n"
             "at a threshold: k of n,  ( p + z²/2n ± z √( p(1−p)/n + z²/4n² ) ) / (1 + z²/n)",
             "D₁ᵢ  largest statistic on signal i,  D₀ⱼ  that of noise block j\n"
             "p = k/n, z = 1.96: 95 %",
             "Billon 2005, section 5; Wilson 1927"),
        make("compare", "A against B",
             "Δ(t, f) = m_B(D_B) − m_A(D_A)\n"
             "m(D) = D − T,  both in nats\n"
             "m(D) = ln P(D′ > T) − ln P(D′ > D),  where one is a power",
             "T  threshold of each\n"
             "P  on noise, from each one's calibration\n"
             "one signal: within 4 cells and 2 frames for half of the time",
             "differencePicture and compareAnalyses in core/evaluate"),
        make("sweep", "Trade-off of a setting",
             "Pd = trials with a track on the line / trials\n"
             "false alarms per hour = tracks that touch no line / hours",
             "every value on the same trials; Pd with Wilson's interval, counts with Garwood's",
             "Wilson 1927; Garwood 1936"),
        make("survey", "Many recordings", "(settings, recording) → events,  for every recording by itself",
             "one set of settings; the threshold is that of each recording's own length and band\n"
             "the row of an event is what detect writes",
             "docs/reference/survey.md"),
        make("map", "A ping",
             "M(n, t) = maxₘ [ ln p(δu) + ln p(δv) + lnL(m, t−1) ],  W = max(M, 0)\n"
             "lnL(n, t) = y(n, t) + W + K,  K(t) = K₀ − mean W",
             "n, m  range, bearing and their rates\n"
             "δu, δv  changes of the rates from ping to ping\n"
             "y  echo over noise, mean 1",
             "Parsons 2008, eq. 8 and 10"),
        make("histories", "Range and bearing against time", "max over the other axis of D(t, range, bearing)",
             "D  best of all rates, as in the maps", "Parsons 2008"),
        make("slice", "A slice through the states",
             "u(n, t) over two axes of n,\n"
             "the other axes at the cursor, or the maximum over them",
             "n  position and rate along every axis of the frames", "Billon 2005, section 3; Parsons 2008, eq. 8"),
        make("latency", "Latency", "pings from a target's appearance to its detection",
             "counted over simulated runs of the scene", "trackScore in core/evaluate"),
        make("targets", "Path of a simulated target", "p(k+1) = p(k) + [ v(k) + v(k+1) ] / 2  on each axis",
             "k  pings since the target appeared\n"
             "v  rate of the leg; over its turn, between that of the leg before and its own",
             "scene/PingScene.h"),
        make("hand", "A line drawn by hand",
             "Σ λ(y(t, f(t)))  over its frames\n"
             "SNR per frame = mean y − 1",
             "f(t)  straight between your points\n"
             "λ  as in the detector, which adds ln P and ln K",
             "λ of Billon 2005, section 4"),
        make("walk", "The sequential test",
             "F_k(n) = e^λ_k(n) · Σₘ P(n|m) F_{k−1}(m),  Λ_k = Σₙ F_k(n)\n"
             "Λ ≥ γ₁ = (1−β)/α: a target;  Λ ≤ γ₀ = β/(1−α): none",
             "k  stage\n"
             "n  cell of the target\n"
             "α, β  permitted probabilities of false alarm and miss",
             "Grossi and Lops 2006, Algorithm 3.1, eq. 4 and 9"),
        make("stopping", "Stopping stages", "ν = first k with Λ_k ≥ γ₁ or Λ_k ≤ γ₀",
             "bars: tests of either hypothesis that stopped at stage ν", "Grossi and Lops 2006, eq. 4"),
        make("posterior", "Posterior of the target's cell", "P(n | received data) = F_k(n) / Λ_k",
             "F_k, Λ_k  as in the test's walk", "Grossi and Lops 2006, Algorithm 3.1"),
        make("scan", "Received power", "10·lg y,  largest over azimuth and elevation",
             "y  power over noise, range × Doppler", "Grossi and Lops 2006, section 4"),
        make("asn", "Stages against SNR",
             "(8a)  H1:  [ β ln γ₀ + (1−β) ln γ₁ ] / D₁\n"
             "(8b)  H0:  [ (1−α) ln γ₀ + α ln γ₁ ] / (−D₀)",
             "D₁, D₀  divergences of one stage, for a known and for an unknown trajectory\n"
             "overshoot is neglected",
             "Grossi and Lops 2006, eq. 8"),
        make("prior", "Stages against the prior", "as against SNR, for a target whose steps have deviation σ",
             "σ = 0  trajectory known, σ = ∞  trajectory unknown", "Grossi and Lops 2006, Figure 2"),
        make("sectors", "A survey of sectors", "saved = 1 − stages taken / stages of tests of fixed size",
             "the fixed test has the same α and β", "Grossi and Lops 2006, section 4"),
        make("sequential", "The sequential test", "Λ ≥ γ₁ = (1−β)/α: a target;  Λ ≤ γ₀ = β/(1−α): none",
             "Λ  likelihood ratio of a target anywhere against noise", "Grossi and Lops 2006, eq. 4 and 9"),
    };
    return all;
}

const Equation *equationOf(const QString &view, const QString &detector)
{
    const QString name = view == QLatin1String("polar")    ? QStringLiteral("map")
                         : view == QLatin1String("output") ? view + QLatin1Char(':') + detector
                                                           : view;
    const auto found = std::find_if(equations().begin(), equations().end(),
                                    [&](const Equation &equation) { return equation.view == name; });
    return found == equations().end() ? nullptr : &*found;
}

} // namespace faintline
