#pragma once

#include "app/commands/keySections.h"

#include <QPointer>
#include <QWidget>

#include <vector>

namespace faintline {

/// Overview of keys and mouse over the window; any key or click closes it.
class KeysOverlay : public QWidget
{
    Q_OBJECT

public:
    explicit KeysOverlay(QWidget *window);

    /// `view`: its keys come first (keysOfView); `menus`: those of the window, whose commands follow.
    void toggle(const QString &view, const QList<QAction *> &menus);

protected:
    bool event(QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void close();

    QPointer<QWidget> m_previousFocus;
    std::vector<KeySection> m_sections;
};

} // namespace faintline
