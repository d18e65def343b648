#pragma once

#include <QObject>
#include <QSet>

namespace faintline {

class AnalysisController;
class Document;
class MessageBar;
class RecordingCheck;

/// Shows advice on the open recording in the message bar, with the remedy as a button: each advice once per recording,
/// never over another message, and never for simulated sources.
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
    QSet<QString> m_told; ///< advice already shown for the open source
};

} // namespace faintline
