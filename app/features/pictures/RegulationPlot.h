#pragma once

#include "plan/Analysis.h"
#include "widgets/plot/StripPlot.h"

namespace faintline {

/// ln K of each frame and, on the right, the fraction of the states whose paths were restarted.
class RegulationPlot : public StripPlot
{
    Q_OBJECT

public:
    explicit RegulationPlot(QWidget *parent = nullptr);

    void setAnalysis(const Analysis &analysis);
    void clear(const QString &emptySentence);
};

} // namespace faintline
