#include "app/features/pictures/PingBar.h"

#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>

namespace faintline {

namespace {

    QToolButton *button(const QString &text, const QString &toolTip)
    {
        auto *result = new QToolButton;
        result->setText(text);
        result->setToolTip(toolTip);
        result->setAutoRaise(true);
        result->setFocusPolicy(Qt::TabFocus);
        return result;
    }

    QCheckBox *checkBox(const QString &text, const QString &toolTip)
    {
        auto *result = new QCheckBox(text);
        result->setToolTip(toolTip);
        result->setFocusPolicy(Qt::TabFocus);
        return result;
    }

} // namespace

PingBar::PingBar(QWidget *parent)
    : QWidget(parent), m_slider(new QSlider(Qt::Horizontal)), m_previous(button(tr("−1"), {})),
      m_next(button(tr("+1"), {})),
      m_polar(checkBox(tr("From above"), tr("Range and bearing as seen from above, north up (P)"))),
      m_reading(new QLabel)
{
    m_slider->setRange(0, 0);
    m_slider->setPageStep(10);
    connect(m_slider, &QSlider::valueChanged, this, [this](int value) { emit pingRequested(value); });
    m_reading->setFont(Theme::font(12));
    m_reading->setTextFormat(Qt::PlainText);
    m_reading->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_reading->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_reading->setContentsMargins(8, 0, 8, 2);
    m_reading->setAccessibleName(tr("Read-out"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(buildRow());
    layout->addWidget(m_reading);
    setFrameName(tr("ping"));
}

void PingBar::setFrameName(const QString &name)
{
    m_slider->setAccessibleName(capitalised(name));
    m_slider->setToolTip(tr("The %1 shown; J and L step, Space plays, Shift+Space plays backwards").arg(name));
    m_previous->setToolTip(tr("One %1 back (J)").arg(name));
    m_next->setToolTip(tr("One %1 forward (L)").arg(name));
}

QLayout *PingBar::buildRow()
{
    auto *backward = button(tr("◀"), tr("Play backwards (Shift+Space)"));
    auto *play = button(tr("▶"), tr("Play (Space)"));
    connect(backward, &QToolButton::clicked, this, &PingBar::backwardClicked);
    connect(m_previous, &QToolButton::clicked, this, [this] { emit stepRequested(-1); });
    connect(m_next, &QToolButton::clicked, this, [this] { emit stepRequested(1); });
    connect(play, &QToolButton::clicked, this, &PingBar::playClicked);
    auto *inhibition = checkBox(tr("Inhibited"), tr("Show the inhibited boxes around tracks"));
    inhibition->setChecked(true);
    auto *conventional = checkBox(tr("Conventional"),
                                  tr("Show tracks found by thresholding each ping: M hits in N pings, in a gate that "
                                     "admits the largest speed (settings conventional.…)"));
    connect(inhibition, &QCheckBox::toggled, this, &PingBar::inhibitionToggled);
    connect(conventional, &QCheckBox::toggled, this, &PingBar::conventionalToggled);
    connect(m_polar, &QCheckBox::toggled, this, &PingBar::polarToggled);

    auto *row = new QHBoxLayout;
    row->setContentsMargins(8, 2, 8, 0);
    row->setSpacing(6);
    row->addWidget(backward);
    row->addWidget(m_previous);
    row->addWidget(m_slider, 1);
    row->addWidget(m_next);
    row->addWidget(play);
    row->addSpacing(10);
    for (QCheckBox *box : {inhibition, conventional, m_polar})
        row->addWidget(box);
    return row;
}

void PingBar::setPingCount(Index count)
{
    const QSignalBlocker blocker(m_slider);
    m_slider->setRange(0, int(count) - 1);
}

void PingBar::setPing(Index ping)
{
    const QSignalBlocker blocker(m_slider);
    m_slider->setValue(int(ping));
}

void PingBar::setPolar(bool isPolar)
{
    m_polar->setChecked(isPolar);
}

void PingBar::setPolarPossible(bool isPossible)
{
    m_polar->setEnabled(isPossible);
}

void PingBar::setReading(const QString &words)
{
    m_words = words;
    fitReading();
}

void PingBar::fitReading()
{
    const QMargins margins = m_reading->contentsMargins();
    const int room = m_reading->width() - margins.left() - margins.right();
    m_reading->setText(m_reading->fontMetrics().elidedText(m_words, Qt::ElideRight, room));
    m_reading->setToolTip(m_reading->text() == m_words ? QString() : asHtml(m_words));
    m_reading->setAccessibleDescription(m_words);
}

void PingBar::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    layout()->activate(); // the label has its width
    fitReading();
}

} // namespace faintline
