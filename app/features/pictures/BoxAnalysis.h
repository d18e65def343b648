#pragma once

#include "plan/AnalysisSettings.h"
#include "widgets/base/Viewport.h"

#include <QList>
#include <QObject>

class QAction;

namespace faintline {

class AnalysisController;
class Document;
class WaterfallView;

/// The settings with the analysis restricted to a box of time and frequency, rounded outward to whole steps of a tenth
/// of a frame and of a bin.
AnalysisSettings inBox(AnalysisSettings settings, const Viewport::Box &box, double frameSeconds, double binHz);

/// *Analyse this box*, *Analyse what I see*: restricts the analysis to the measured box or to the visible part, and
/// returns to the whole recording. Adds its actions to the menus of the pictures.
class BoxAnalysis : public QObject
{
    Q_OBJECT

public:
    BoxAnalysis(Document &document, AnalysisController &controller, const std::vector<WaterfallView *> &views,
                QObject *parent = nullptr);

    QList<QAction *> actions() const { return {m_box, m_visible, m_all}; }

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
