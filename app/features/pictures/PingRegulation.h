#pragma once

#include "plan/Analysis.h"

#include <QWidget>

class QLabel;

namespace faintline {

class RegulationPlot;
class Viewport;

/// ln K and the reset fraction of each ping, with ln K's band on noise, and a warning where signals bias K low.
class PingRegulation : public QWidget
{
    Q_OBJECT

public:
    /// `time`: time × range; not owned.
    explicit PingRegulation(Viewport &time, QWidget *parent = nullptr);

    void show(const Analysis &analysis);
    void clear(const QString &emptySentence);
    RegulationPlot &plot() const { return *m_plot; }

private:
    QLabel *m_dragged; ///< the warning
    RegulationPlot *m_plot;
};

} // namespace faintline
