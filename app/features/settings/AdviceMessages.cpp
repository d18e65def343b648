#include "app/features/settings/AdviceMessages.h"

#include "app/base/MessageBar.h"
#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "app/document/RecordingCheck.h"
#include "widgets/base/quantities.h"

#include <algorithm>

namespace faintline {

AdviceMessages::AdviceMessages(const Document &document, AnalysisController &controller, const RecordingCheck &check,
                               MessageBar &messages, QObject *parent)
    : QObject(parent), m_document(document), m_controller(controller), m_check(check), m_messages(messages)
{
    connect(&document, &Document::opened, this, [this] { m_told.clear(); });
    connect(&check, &RecordingCheck::changed, this, &AdviceMessages::tell);
}

void AdviceMessages::tell()
{
    if (m_check.isCounting())
        return;
    const std::vector<Advice> all = m_check.advice();
    const auto next = std::find_if(all.begin(), all.end(), [this](const Advice &advice) {
        return !m_told.contains(QString::fromStdString(advice.name));
    });
    if (next == all.end() || m_document.source().isSimulated() || !m_messages.text().isEmpty())
        return;
    m_told.insert(QString::fromStdString(next->name));
    const QString remedy = capitalised(QString::fromStdString(next->remedy));
    m_messages.showMessage(
        MessageBar::Kind::Notice, m_document.sourceName(), QString::fromStdString(next->sentence) + QLatin1Char('.'),
        remedy, [this, remedy, settings = m_check.remedied(*next)] { m_controller.setSettings(settings, remedy); });
}

} // namespace faintline
