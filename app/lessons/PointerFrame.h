#pragma once

#include <QPointer>
#include <QWidget>

namespace faintline {

/// A frame around a highlighted widget. It lets clicks through and follows the widget.
class PointerFrame : public QWidget
{
    Q_OBJECT

public:
    explicit PointerFrame(QWidget *window);

    void pointAt(QWidget *target); ///< null: none
    QWidget *target() const { return m_target; }

public slots:
    void follow();

protected:
    void paintEvent(QPaintEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    QPointer<QWidget> m_target;
};

} // namespace faintline
