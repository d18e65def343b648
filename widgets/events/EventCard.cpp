#include "widgets/events/EventCard.h"

#include "widgets/base/FlowLayout.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/events/EventModel.h"

#include <QAction>
#include <QEvent>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <cmath>

namespace faintline {

namespace {

    struct Fact {
        QString name, value;
    };

    /// A column's heading "SNR (dB)" and its value 12.3 as "SNR" and "12.3 dB"; without a value if the column has none.
    Fact factOf(const EventModel &model, int row, int column)
    {
        const QString heading = model.headerData(column, Qt::Horizontal).toString();
        const QString value = model.index(row, column).data().toString();
        const auto open = heading.indexOf(QLatin1String(" ("));
        const bool isMissing = value.isEmpty() || value == QStringLiteral("–");
        if (open < 0 || !heading.endsWith(QLatin1Char(')')))
            return {heading, isMissing ? QString() : value};
        const QString unit = heading.mid(open + 2, heading.size() - open - 3);
        return {heading.left(open), isMissing                      ? QString()
                                    : unit == QLatin1String("UTC") ? value
                                                                   : value + QLatin1Char(' ') + unit};
    }

} // namespace

EventCard::EventCard(const EventModel &model, QWidget *parent)
    : QWidget(parent), m_model(model), m_title(plainLabel()), m_facts(new QLabel), m_buttons(new QWidget)
{
    setAccessibleName(tr("Selected event"));
    m_title->setFont(Theme::boldFont());
    m_facts->setTextFormat(Qt::RichText);
    m_facts->setWordWrap(true);
    m_facts->setFont(Theme::font(12));
    new FlowLayout(m_buttons);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 2, 4, 2);
    layout->setSpacing(2);
    layout->addWidget(m_title);
    layout->addWidget(m_facts);
    layout->addWidget(m_buttons);
}

void EventCard::setActions(const QList<QAction *> &actions)
{
    for (QAction *action : actions) {
        auto *button = new QToolButton;
        button->setDefaultAction(action);
        button->setToolButtonStyle(Qt::ToolButtonTextOnly);
        m_buttons->layout()->addWidget(button);
    }
}

void EventCard::setRow(int row)
{
    m_row = row < m_model.rowCount() ? row : -1;
    fill();
}

QString EventCard::text() const
{
    return m_title->text() + QLatin1Char('\n') + m_facts->text();
}

void EventCard::fill()
{
    if (m_row < 0)
        return;
    const Event &event = m_model.events()[std::size_t(m_row)];
    m_title->setText(event.kind > SignalKind::Line
                         ? tr("Event %1, %2").arg(event.id).arg(QString::fromStdString(nameOf(event.kind)))
                         : tr("Event %1").arg(event.id));
    std::vector<Fact> facts;
    for (const int column :
         {EventModel::Frequency, EventModel::Bearing, EventModel::ThirdAxis, EventModel::FourthAxis, EventModel::Snr})
        if (column == EventModel::Frequency || column == EventModel::Snr
            || m_model.hasColumn(EventModel::Column(column)))
            facts.push_back(factOf(m_model, m_row, column));
    if (!m_model.hasBearing())
        facts.front().name = tr("Frequency");
    const QString from = factOf(m_model, m_row, EventModel::Onset).value;
    const QString to = factOf(m_model, m_row, EventModel::End).value;
    const bool isClock = from.contains(QLatin1Char(':'));
    facts.push_back({tr("Time"), isClock ? tr("%1 … %2").arg(from, to) : tr("%1 … %2 s").arg(from, to)});
    for (const int column :
         {EventModel::Drift, EventModel::Window, EventModel::Call, EventModel::Utc, EventModel::Radio})
        if (column != EventModel::Radio || m_model.hasRadio())
            facts.push_back(factOf(m_model, m_row, column));
    for (const int column : {EventModel::Chance, EventModel::Class, EventModel::Judged, EventModel::Note})
        facts.push_back(factOf(m_model, m_row, column));
    QStringList words;
    const QString faint = Theme::colours(*this).faintText.name();
    for (const Fact &fact : facts)
        if (!fact.value.isEmpty())
            words << QStringLiteral("<span style='color:%1'>%2</span>&nbsp;%3")
                         .arg(faint, fact.name.toHtmlEscaped().replace(QLatin1Char(' '), QStringLiteral("&nbsp;")),
                              fact.value.toHtmlEscaped().replace(QLatin1Char(' '), QStringLiteral("&nbsp;")));
    m_facts->setText(words.join(QStringLiteral(" &nbsp; ")));
}

void EventCard::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        fill();
}

} // namespace faintline
