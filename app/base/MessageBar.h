#pragma once

#include <QFrame>

#include <functional>

class QLabel;
class QToolButton;

namespace faintline {

/// One sentence over the lower edge of the pictures that stays until it is dismissed or replaced.
class MessageBar : public QFrame
{
    Q_OBJECT

public:
    enum class Kind { Notice, Error };

    explicit MessageBar(QWidget *parent = nullptr);

    /// `action`: called by a button with that text; no text, no button.
    void showMessage(Kind kind, const QString &where, const QString &why, const QString &actionText = {},
                     std::function<void()> action = {});
    void dismiss() { hide(); }

    QString text() const; ///< empty while nothing is shown

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    Kind m_kind = Kind::Notice;
    QLabel *m_label;
    QToolButton *m_actionButton;
    std::function<void()> m_action;
};

} // namespace faintline
