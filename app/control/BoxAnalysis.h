#pragma once

#include "plan/AnalysisSettings.h"
#include "widgets/base/Viewport.h"

#include <QObject>

class QAction;
class QMenu;

namespace faintline {

class AnalysisController;
class Document;
class WaterfallView;

/// The settings with the analysis restricted to a box of time and frequency, rounded outward to whole steps of a tenth
/// of a frame and of a bin.
AnalysisSettings inBox(AnalysisSettings settings, const Viewport::Box &box, double frameSeconds, double binHz);

/// *Analyse this box*, *Analyse what I see*: restricts the analysis to the measured box or to the visible part, and
/// returns to the whole recording. Adds actions to the menu, and to those of the pictures.
class BoxAnalysis : public QObject
{
    Q_OBJECT

public:
    BoxAnalysis(Document &document, AnalysisController &controller, const std::vector<WaterfallView *> &views,
                QObject *parent = nullptr);

    void addActionsTo(QMenu &menu);

    void analyseBox();
    void analyseVisible();
    void analyseAll();

private:
    void enable();

    Document &m_document;
    AnalysisController &m_controller;
    QAction *m_box;
    QAction *m_visible;
    QAction *m_all;
};

} // namespace faintline
