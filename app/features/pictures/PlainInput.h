#pragma once

#include "app/base/Inquiry.h"
#include "inspect/closeup.h"

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

signals:
    void changed(); ///< the picture
    void failed(const faintline::Error &error);

private:
    void follow();

    Document &m_document;
    QAction *m_action;
    Inquiry<std::optional<PlainPicture>, std::shared_ptr<const Analysis>> m_plain;
};

} // namespace faintline
