#pragma once

#include "plan/Analysis.h"
#include "plan/AnalysisSettings.h"

#include <vamp-sdk/Plugin.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// The detector in a Vamp host: events as regions, tracks as curves, the statistic as a grid.
///
/// A host hands over the samples block by block; the search begins when it has given all of them, so they are held in
/// memory. It is that of `faintline-cli detect`, and finds the same events: programs are the presets, parameters the
/// settings that are numbers of their own (any other setting keeps its preset's value). A host fills up the last block
/// with zeros, which are taken off. The labels of regions are the lines of the table that `detect --events` writes.
class DetectorPlugin final : public Vamp::Plugin
{
public:
    explicit DetectorPlugin(float sampleRate) : Plugin(sampleRate), m_rateHz(double(sampleRate)) {}

    InputDomain getInputDomain() const override { return TimeDomain; }
    std::string getIdentifier() const override { return "detector"; }
    std::string getName() const override { return "Faint lines"; }
    std::string getDescription() const override;
    std::string getMaker() const override { return "Faintline"; }
    int getPluginVersion() const override { return 1; }
    std::string getCopyright() const override { return "GPL-3.0-or-later"; }

    ParameterList getParameterDescriptors() const override;
    float getParameter(std::string identifier) const override;
    void setParameter(std::string identifier, float value) override;
    ProgramList getPrograms() const override;
    std::string getCurrentProgram() const override { return m_program; }
    void selectProgram(std::string name) override;
    OutputList getOutputDescriptors() const override;

    bool initialise(std::size_t channels, std::size_t stepSize, std::size_t blockSize) override;
    void reset() override;
    FeatureSet process(const float *const *inputBuffers, Vamp::RealTime timestamp) override;
    FeatureSet getRemainingFeatures() override;

private:
    enum Output { Events, Tracks, Statistic };
    struct Found {
        std::shared_ptr<const Analysis> analysis;
        std::vector<std::vector<float>> statistic; ///< frame by frame
    };

    AnalysisSettings settings() const;
    std::vector<float> samples() const;
    Found search() const;
    FeatureList regions(const Analysis &analysis) const;
    FeatureList curves(const Analysis &analysis) const;
    static FeatureList grid(const Found &found);

    double m_rateHz;
    std::string m_program = "lines";
    std::map<std::string, float> m_parameters; ///< those that were set
    std::size_t m_blockSize = 0;
    std::vector<float> m_samples;
};

} // namespace faintline
