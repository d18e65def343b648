#pragma once

#include "app/base/JobRunner.h"
#include "inspect/closeup.h"

#include <QObject>

#include <memory>
#include <optional>

class QAction;

namespace faintline {

class Document;
class WaterfallView;

/// The input's power itself, in dB, to be shown in place of the power over the noise: computed from the recording on a
/// worker while its action is checked.
class PlainInput : public QObject
{
    Q_OBJECT

public:
    /// Adds the action to the input's menu.
    PlainInput(Document &document, WaterfallView &input, QObject *parent = nullptr);

    QAction *action() const { return m_action; }
    /// The picture of the document's analysis; null unless it is wanted and computed.
    std::shared_ptr<const PeakPyramid> picture() const;
    QString heading() const; ///< precondition: there is a picture
    bool isBusy() const { return m_runner.isRunning(); }

signals:
    void changed(); ///< the picture
    void settled();
    void failed(const faintline::Error &error);

private:
    void follow();

    Document &m_document;
    QAction *m_action;
    std::shared_ptr<const Analysis> m_analysis; ///< of the picture
    std::optional<PlainPicture> m_plain;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
