#include "widgets/base/ReadOut.h"

#include "base/utc.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    const QString dash = QStringLiteral("–");

    /// "2024-07-26 00:00:12.5", with the frame's precision.
    QString utcText(double unixSeconds, int decimals)
    {
        const double scale = std::pow(10.0, decimals);
        QString text = QString::fromStdString(formatUtc(std::round(unixSeconds * scale) / scale));
        text.replace(QLatin1Char('T'), QLatin1Char(' ')).remove(QLatin1Char('Z'));
        return text;
    }

} // namespace

ReadOut::ReadOut(QWidget *parent) : QWidget(parent)
{
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 2, 8, 2);
    layout->setSpacing(16);
    layout->setSizeConstraint(QLayout::SetNoConstraint); // so that the line does not widen a narrow window
    setMinimumWidth(600);
    m_time = addItem(tr("Time"), tr("t"), QStringLiteral("00:00:00.00"));
    m_utc = addItem(tr("UTC"), tr("UTC"), QStringLiteral("0000-00-00 00:00:00.00"));
    m_frequency = addItem(tr("Frequency"), tr("f"), QStringLiteral("0000.000 kHz"));
    m_radio = addItem(tr("Radio"), tr("RF"), QStringLiteral("000.000000 MHz"));
    m_level = addItem(tr("Level"), tr("L"), QStringLiteral("−00.0 dB"));
    m_statistic = addItem(tr("Statistic"), tr("D"), QStringLiteral("000.00 × noise"));
    m_slope = addItem(tr("Drift"), tr("Drift"), QStringLiteral("−00.000 Hz/s"));
    m_age = addItem(tr("Path"), tr("Path"), {});
    layout->addStretch(1);
    m_radio.box->setToolTip(tr("Radio frequency: the recording's centre frequency plus the offset"));
    m_level.box->setToolTip(tr("Power over the mean of the noise"));
    m_statistic.box->setToolTip(tr("The detector's statistic D"));
    m_slope.box->setToolTip(tr("Drift of the best path into this cell, or of the track through it"));
    m_age.box->setToolTip(tr("Time since the last reset of the best path that ends in this cell; computed while a "
                             "layer (V) or the state space (S) is shown"));
    setAccessibleName(tr("Read-out"));
    setStartUnixSeconds({});
    setCentreHz(0.0);
    clear();
}

ReadOut::Item ReadOut::addItem(const QString &name, const QString &brief, const QString &widest)
{
    Item item{new QWidget, new QLabel(name), new QLabel, name, brief};
    item.name->setFont(Theme::font(12));
    item.name->setForegroundRole(QPalette::PlaceholderText);
    item.value->setFont(Theme::monoFont(12));
    item.value->setMinimumWidth(QFontMetrics(item.value->font()).horizontalAdvance(widest));
    item.value->setAccessibleName(name);
    auto *row = new QHBoxLayout(item.box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(6);
    row->addWidget(item.name);
    row->addWidget(item.value);
    layout()->addWidget(item.box);
    return item;
}

void ReadOut::setStartUnixSeconds(std::optional<double> unixSeconds)
{
    m_startUnixSeconds = unixSeconds;
    m_utc.isKnown = unixSeconds.has_value();
    setReading(m_reading);
}

void ReadOut::setCentreHz(double hz)
{
    m_centreHz = hz;
    m_radio.isKnown = hz != 0.0;
    setReading(m_reading);
}

void ReadOut::setFrequencyName(const QString &name)
{
    m_frequency.whole = name;
    m_frequency.value->setAccessibleName(name);
    fit();
}

void ReadOut::setResolution(double frameSeconds, double binHz, double lengthSeconds)
{
    m_isClock = lengthSeconds > clockFromSeconds;
    m_frameSeconds = frameSeconds;
    m_binHz = binHz;
    setReading(m_reading);
}

void ReadOut::setStatisticUnit(const QString &unit)
{
    m_statisticUnit = unit;
    setReading(m_reading);
}

void ReadOut::setReading(const Reading &reading)
{
    m_reading = reading;
    const auto show = [](const Item &item, const std::optional<double> &value, auto words) {
        item.value->setText(value ? words(*value) : dash);
    };
    show(m_time, reading.seconds, [this](double v) {
        return m_isClock ? clockText(v, decimalsFor(m_frameSeconds), true) : secondsText(v, m_frameSeconds);
    });
    show(m_utc, reading.seconds,
         [this](double v) { return utcText(m_startUnixSeconds.value_or(0.0) + v, decimalsFor(m_frameSeconds)); });
    show(m_frequency, reading.hz, [this](double v) { return hertzText(v, m_binHz); });
    show(m_radio, reading.hz, [this](double v) { return hertzText(m_centreHz + v, m_binHz); });
    show(m_level, reading.levelDb, [](double v) { return numberText(v, 1) + tr(" dB"); });
    const int decimals = m_statisticUnit == QLatin1String("nat") ? 1 : 2;
    show(m_statistic, reading.statisticNats,
         [&](double v) { return numberText(v, decimals) + QLatin1Char(' ') + m_statisticUnit; });
    show(m_slope, reading.slopeHzPerSecond, [](double v) { return powerText(v, 3) + tr(" Hz/s"); });
    show(m_age, reading.ageSeconds, [this](double v) { return secondsText(v, m_frameSeconds); });
    m_age.isKnown = reading.ageSeconds.has_value();
    fit();
    setAccessibleDescription(text());
}

std::array<const ReadOut::Item *, 8> ReadOut::items() const
{
    return {&m_time, &m_utc, &m_frequency, &m_radio, &m_level, &m_statistic, &m_slope, &m_age};
}

int ReadOut::widthOf(const Item &item, const QString &name) const
{
    const int value =
        std::max(item.value->minimumWidth(), item.value->fontMetrics().horizontalAdvance(item.value->text()));
    return item.name->fontMetrics().horizontalAdvance(name) + item.box->layout()->spacing() + value
           + layout()->spacing();
}

/// In a narrow line the names become symbols, and figures without room are not shown; none is cut.
void ReadOut::fit()
{
    const QMargins margins = layout()->contentsMargins();
    const int room = width() - margins.left() - margins.right();
    const auto needed = [&](bool isBrief) {
        int sum = 0;
        for (const Item *item : items())
            sum += item->isKnown ? widthOf(*item, isBrief ? item->brief : item->whole) : 0;
        return sum;
    };
    const bool isBrief = needed(false) > room;
    int excess = isBrief ? needed(true) - room : 0;
    for (const Item *item : items()) {
        item->name->setText(isBrief ? item->brief : item->whole);
        item->box->setVisible(item->isKnown);
    }
    for (const Item *item : {&m_age, &m_utc, &m_slope, &m_radio}) {
        if (excess <= 0)
            break;
        excess -= item->isKnown ? widthOf(*item, item->brief) : 0;
        item->box->hide();
    }
    for (const Item *item : items())
        item->box->layout()->activate(); // names of another width, at once
    layout()->activate();
}

void ReadOut::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    fit();
}

QString ReadOut::text() const
{
    QStringList words;
    for (const Item *item : items())
        if (item->isKnown && item->value->text() != dash)
            words << item->value->text();
    return words.join(QStringLiteral(" · "));
}

void ReadOut::contextMenuEvent(QContextMenuEvent *event)
{
    QMenu menu(this);
    menu.addAction(tr("Copy"), this, [this] { QApplication::clipboard()->setText(text()); })
        ->setEnabled(!text().isEmpty());
    menu.exec(event->globalPos());
}

} // namespace faintline
