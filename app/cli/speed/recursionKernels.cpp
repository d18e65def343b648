#include "app/cli/speed/kernels.h"

#include "app/cli/speed/SpeedKernel.h"
#include "app/cli/speed/plainForms.h"
#include "base/LargeVector.h"
#include "detect/Smd.h"
#include "model/sonarModels.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace faintline {

namespace {

    const char *const formula = "formula";
    const char *const eigen = "Eigen";
    const char *const pass = "pass";

    /// A detector that processes the same frames cyclically.
    template <class D>
    class Running
    {
    public:
        Running(D detector, Index cells, Index frames)
            : m_detector(std::move(detector)), m_cells(std::size_t(cells)), m_frames(std::size_t(frames)),
              m_y(exponentials(m_cells * m_frames)), m_statistic(m_y.size())
        {
            oneByOne();
        }

        void oneByOne()
        {
            for (std::size_t i = 0; i < m_frames; ++i)
                m_detector.update(std::span<const float>(m_y).subspan(i * m_cells, m_cells),
                                  std::span(m_statistic).subspan(i * m_cells, m_cells));
        }

        void atOnce() { m_detector.updateBlock(m_y, m_statistic, Index(m_cells)); }

    private:
        D m_detector;
        std::size_t m_cells;
        std::size_t m_frames;
        std::vector<float> m_y;
        std::vector<float> m_statistic;
    };

    template <class D>
    SpeedForm running(const std::string &name, D detector, const StateSpace &space, Index frames)
    {
        const auto it = std::make_shared<Running<D>>(std::move(detector), space.cellCount(), frames);
        return {name, double(space.stateCount() * frames), 1, [it] { it->oneByOne(); }};
    }

    SpeedForm smd(const std::string &name, const MarkovModel &model, Index frames, double lnK, int threads = 1)
    {
        Smd detector(model, {ResetLaw::Fixed, lnK});
        detector.useThreads(threads);
        const auto it = std::make_shared<Running<Smd>>(std::move(detector), model.space.cellCount(), frames);
        return {name, double(model.space.stateCount() * frames), threads, [it] { it->atOnce(); }};
    }

    SpeedForm passOver(const StateSpace &space)
    {
        const std::vector<float> some = exponentials(std::size_t(space.stateCount()));
        const auto values = std::make_shared<LargeVector<float>>(some.begin(), some.end());
        return {pass, double(space.stateCount()), 1, [values] { sweep(*values); }};
    }

    // ---- one axis --------------------------------------------------------------------------------------------------

    constexpr Index blockFrames = 16;

    MarkovModel slopes(int count, Index cells)
    {
        const double third = 1.0 / 3.0;
        return {StateSpace({KinematicAxis{"frequency", cells, false, -(count - 1) / 2, count, {third, third}, {}}}),
                Likelihood(LikelihoodKind::Linear), 1.0};
    }

    /// Above it the mean of λ + ln K + ln h is negative: scores neither grow without bound nor vanish.
    constexpr double slopesLnK = -1.0;

    std::vector<SpeedForm> slopeForms(int count, Index cells)
    {
        const MarkovModel model = slopes(count, cells);
        return {smd(ours, model, blockFrames, slopesLnK),
                running(formula, FormulaRecursion(model.space, slopesLnK), model.space, 1),
                running(eigen, EigenRecursion(model.space, float(slopesLnK)), model.space, 2),
                passOver(model.space),
                running("frame by frame", Smd(model, {ResetLaw::Fixed, slopesLnK}), model.space, blockFrames),
                smd(twoThreads, model, blockFrames, slopesLnK, 2)};
    }

    /// Largest difference between the statistics of a detector and of the formula over some frames.
    double difference(const MarkovModel &model, double lnK, Index frames)
    {
        const auto cells = std::size_t(model.space.cellCount());
        const std::vector<float> y = exponentials(cells * std::size_t(frames));
        std::vector<float> found(y.size());
        std::vector<float> expected(cells);
        Smd detector(model, {ResetLaw::Fixed, lnK});
        detector.updateBlock(y, found, model.space.cellCount());
        FormulaRecursion plain(model.space, lnK);
        double largest = 0.0;
        for (std::size_t frame = 0; frame < std::size_t(frames); ++frame) {
            plain.update(std::span<const float>(y).subspan(frame * cells, cells), expected);
            for (std::size_t cell = 0; cell < cells; ++cell)
                largest = std::max(largest, double(std::abs(found[frame * cells + cell] - expected[cell])));
        }
        return largest;
    }

    SpeedCheck sameAsFormula(const MarkovModel &small, double lnK)
    {
        return {"largest difference from the formula over 40 frames, nat", 1e-4,
                [small, lnK] { return difference(small, lnK, 40); }};
    }

    // ---- two axes --------------------------------------------------------------------------------------------------

    constexpr Index sonarFrames = 8;

    MarkovModel sonar(const SonarMotion &motion, Index ranges)
    {
        const Grid grid{{{"range", "m", 0.0, 1.0, ranges, false}, {"bearing", "deg", 0.0, 18.0, 20, true}}};
        return sonarModel(grid, motion);
    }

    double sonarLnK(const SonarMotion &motion)
    {
        return motion.rangeRateChange.size() > 1 ? -0.5 : -1.386;
    }

    std::vector<SpeedForm> sonarForms(const SonarMotion &motion, bool withFormula)
    {
        const MarkovModel model = sonar(motion, 2500);
        const double lnK = sonarLnK(motion);
        std::vector<SpeedForm> forms{
            smd(ours, model, sonarFrames, lnK), running(eigen, EigenRecursion(model.space, float(lnK)), model.space, 1),
            passOver(model.space),
            running("frame by frame", Smd(model, {ResetLaw::Fixed, lnK}), model.space, sonarFrames),
            smd(twoThreads, model, sonarFrames, lnK, 2)};
        if (withFormula)
            forms.push_back(running(formula, FormulaRecursion(model.space, lnK), model.space, 1));
        return forms;
    }

    struct NamedModel {
        std::string name;
        MarkovModel model;
    };

    std::vector<SpeedForm> sizes(const NamedModel &few, const NamedModel &many, Index frames, double lnK)
    {
        const Index more = std::max<Index>(1, many.model.space.stateCount() / few.model.space.stateCount() / 8);
        return {smd(many.name, many.model, frames, lnK), smd(few.name, few.model, frames * more, lnK),
                passOver(many.model.space)};
    }

} // namespace

std::vector<SpeedKernel> recursionKernels()
{
    return {
        {"recursion-21",
         "one axis, 21 slopes, 100 000 cells",
         "state",
         {{ours, formula, 12.0}, {ours, eigen, 4.0}, {ours, pass, 1.3}, {twoThreads, ours, 1.5}},
         [] { return slopeForms(21, 100'000); },
         {sameAsFormula(slopes(21, 3000), slopesLnK)}},
        {"recursion-5",
         "one axis, 5 slopes, 100 000 cells",
         "state",
         {{ours, formula, 10.0}, {ours, eigen, 5.0}, {twoThreads, ours, 1.5}},
         [] { return slopeForms(5, 100'000); },
         {sameAsFormula(slopes(5, 3000), slopesLnK)}},
        {"recursion-large",
         "one axis, 21 slopes, 21 million states",
         "state",
         {{"21 M states", "0.2 M states", 0.75}, {"21 M states", pass, 1.3}},
         [] {
             return sizes({"0.2 M states", slopes(21, 10'000)}, {"21 M states", slopes(21, 1'000'000)}, blockFrames,
                          slopesLnK);
         }},
        {"sonar-27",
         "two axes, 27 transitions, 6.15 million states",
         "state",
         {{ours, formula, 40.0}, {ours, eigen, 4.0}, {ours, pass, 0.25}, {twoThreads, ours, 1.6}},
         [] { return sonarForms(manoeuvring(), true); },
         {sameAsFormula(sonar(manoeuvring(), 150), sonarLnK(manoeuvring()))}},
        {"sonar-1",
         "two axes, one-to-one, 6.15 million states",
         "state",
         {{ours, eigen, 2.5}, {ours, pass, 1.0}, {twoThreads, ours, 1.5}},
         [] { return sonarForms(nonManoeuvring(), false); },
         {sameAsFormula(sonar(nonManoeuvring(), 150), sonarLnK(nonManoeuvring()))}},
        {"sonar-large",
         "two axes, 27 transitions, 24.6 million states",
         "state",
         {{"24.6 M states", "3 M states", 0.85}, {"24.6 M states", pass, 0.25}},
         [] {
             return sizes({"3 M states", sonar(manoeuvring(), 1250)}, {"24.6 M states", sonar(manoeuvring(), 10'000)},
                          2, sonarLnK(manoeuvring()));
         }},
    };
}

} // namespace faintline
