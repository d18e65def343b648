#pragma once

#include <QObject>
#include <QSet>

namespace faintline {

class AnalysisController;
class Document;
class MessageBar;
class RecordingCheck;

/// Says in the message bar what should be known of the recording that is open, with the remedy as a button: each advice
/// once for each recording, never over another message, and never of what was simulated on purpose.
class AdviceMessages : public QObject
{
    Q_OBJECT

public:
    AdviceMessages(const Document &document, AnalysisController &controller, const RecordingCheck &check,
                   MessageBar &messages, QObject *parent = nullptr);

private:
    void tell();

    const Document &m_document;
    AnalysisController &m_controller;
    const RecordingCheck &m_check;
    MessageBar &m_messages;
    QSet<QString> m_told; ///< of what is open
};

} // namespace faintline
