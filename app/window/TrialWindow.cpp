#include "app/window/TrialWindow.h"

#include "app/document/statisticUnit.h"
#include "app/features/pictures/Workbench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/labelText.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

TrialWindow::TrialWindow(QWidget *parent)
    : QWidget(parent, Qt::Window), m_workbench(new Workbench(m_document)), m_readOut(new ReadOut),
      m_sentence(panelSentence()), m_previous(new QPushButton(tr("Previous trial"))),
      m_next(new QPushButton(tr("Next trial"))), m_nextMissed(new QPushButton(tr("Next miss")))
{
    setObjectName(QStringLiteral("trialWindow"));
    m_sentence->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_nextMissed->setToolTip(tr("Next trial of this point in which the line was missed"));
    auto *top = new QHBoxLayout;
    top->setContentsMargins(10, 6, 10, 4);
    top->addWidget(m_sentence, 1);
    for (QPushButton *button : {m_previous, m_next, m_nextMissed}) {
        button->setAutoDefault(false);
        top->addWidget(button);
    }
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(m_workbench, 1);
    layout->addWidget(m_readOut);
    resize(1200, 760);

    connect(m_previous, &QPushButton::clicked, this, [this] { emit stepRequested(-1, false); });
    connect(m_next, &QPushButton::clicked, this, [this] { emit stepRequested(1, false); });
    connect(m_nextMissed, &QPushButton::clicked, this, [this] { emit stepRequested(1, true); });
    connect(m_workbench, &Workbench::readingChanged, m_readOut, &ReadOut::setReading);
    connect(m_workbench, &Workbench::eventActivated, m_workbench, &Workbench::selectEvent);
}

void TrialWindow::show(const ShownTrial &trial, const QString &title, const QString &sentence)
{
    const Analysis &analysis = *trial.analysis;
    setWindowTitle(title);
    m_sentence->setText(sentence);
    OpenedSource opened;
    opened.recording = analysis.recording;
    opened.truth = trial.truth;
    m_document.setOpened(std::move(opened), analysis.settings);
    m_readOut->setStatisticUnit(statisticUnit(analysis.settings));
    m_readOut->setResolution(analysis.time().step, analysis.grid().axes.back().step, analysis.time().last());
    m_document.setAnalysis(trial.analysis, events(analysis));
    if (analysis.recording) { // the line's neighbourhood in a whole recording
        const TruthLine &line = trial.truth.lines.front();
        const double seconds = 0.5 * (line.endSeconds - line.startSeconds);
        const auto [low, high] = std::minmax_element(line.frequencyHz.begin(), line.frequencyHz.end());
        const double hz = std::max(*high - *low, 60.0 * analysis.grid().axes.back().step);
        m_document.viewport().zoomTo({line.startSeconds - seconds, line.endSeconds + seconds}, {*low - hz, *high + hz});
    }
    setBusy(false);
    QWidget::show();
    raise();
}

void TrialWindow::setBusy(bool isBusy)
{
    for (QPushButton *button : {m_previous, m_next, m_nextMissed})
        button->setEnabled(!isBusy);
}

void TrialWindow::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        close();
    else
        QWidget::keyPressEvent(event);
}

} // namespace faintline
