#include "app/features/pictures/PlainInput.h"

#include "app/document/Document.h"
#include "base/memoryShares.h"
#include "widgets/base/quantities.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QMenu>

namespace faintline {

PlainInput::PlainInput(Document &document, WaterfallView &input, QObject *parent)
    : QObject(parent), m_document(document), m_action(new QAction(tr("Input as &plain dB"), this)),
      m_plain(
          this, [this] { return m_plain.questionIf(m_action->isEnabled(), {}, m_document.lineAnalysis()); },
          [](const auto &analysis, const RunContext &context) {
              return plainPicture(*analysis, memoryShares::picture, context);
          },
          &PlainInput::changed)
{
    m_action->setCheckable(true);
    m_action->setShortcut(QKeySequence(Qt::SHIFT | Qt::Key_D));
    m_action->setToolTip(tr("Show the level itself, as other spectrograms do, instead of the level over the noise"));
    connect(m_action, &QAction::toggled, this, [this] {
        emit changed();
        follow();
    });
    connect(&input, &WaterfallView::contextMenuRequested, this, [this](QMenu *menu) {
        menu->addSeparator();
        menu->addAction(m_action);
    });
    connect(&document, &Document::analysisChanged, this, &PlainInput::follow);
    connect(&document, &Document::opened, this, &PlainInput::follow);
    connect(&m_plain, &JobRunner::failed, this, &PlainInput::failed);
    follow();
}

std::shared_ptr<const PeakPyramid> PlainInput::picture() const
{
    const auto *plain = m_plain.answerAbout(m_document.analysis());
    return m_action->isChecked() && plain && *plain ? (*plain)->picture : nullptr;
}

QString PlainInput::heading() const
{
    return tr("Input (dB over %1 dB re full scale²/Hz)").arg(numberText((*m_plain.answer())->referenceDb, 0));
}

void PlainInput::follow()
{
    const auto analysis = m_document.lineAnalysis();
    m_action->setEnabled(analysis && analysis->recording && analysis->settings.family.isNone());
    m_action->isEnabled() && !m_action->isChecked() ? m_plain.cancel() : m_plain.ask();
}

} // namespace faintline
