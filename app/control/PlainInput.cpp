#include "app/control/PlainInput.h"

#include "app/document/Document.h"
#include "base/memoryShares.h"
#include "widgets/base/quantities.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QMenu>

namespace faintline {

PlainInput::PlainInput(Document &document, WaterfallView &input, QObject *parent)
    : QObject(parent), m_document(document), m_action(new QAction(tr("Input as &plain dB"), this))
{
    m_action->setCheckable(true);
    m_action->setShortcut(QKeySequence(Qt::SHIFT | Qt::Key_D));
    m_action->setToolTip(tr("Show the level itself, as other spectrograms do, instead of the level over the noise"));
    connect(m_action, &QAction::toggled, this, [this] {
        emit changed();
        follow();
    });
    connect(&input, &WaterfallView::contextMenuRequested, this, [this](QMenu *menu) { menu->addAction(m_action); });
    connect(&document, &Document::analysisChanged, this, &PlainInput::follow);
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_analysis.reset();
        m_plain.reset();
        follow();
    });
    connect(&m_runner, &JobRunner::finished, this, &PlainInput::settled);
    connect(&m_runner, &JobRunner::cancelled, this, &PlainInput::settled);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        emit settled();
    });
    follow();
}

std::shared_ptr<const PeakPyramid> PlainInput::picture() const
{
    return m_action->isChecked() && m_plain && m_analysis == m_document.analysis() ? m_plain->picture : nullptr;
}

QString PlainInput::heading() const
{
    return tr("Input (dB over %1 dB re full scale²/Hz)").arg(numberText(m_plain->referenceDb, 0));
}

void PlainInput::follow()
{
    m_runner.cancel();
    const auto analysis = m_document.lineAnalysis();
    m_action->setEnabled(analysis && analysis->recording && analysis->settings.family.isNone() && !m_document.isLive());
    if (!m_action->isEnabled() || !m_action->isChecked() || m_analysis == analysis)
        return;
    m_runner.start([this, analysis](const RunContext &context) -> JobRunner::Delivery {
        return [this, analysis, plain = plainPicture(*analysis, memoryShares::picture, context)] {
            m_analysis = analysis;
            m_plain = plain;
            emit changed();
        };
    });
}

} // namespace faintline
