#include "app/features/events/ComparePanel.h"

#include "app/document/statisticUnit.h"
#include "app/document/trackBox.h"
#include "app/features/events/differenceWords.h"
#include "evaluate/comparison/differencePicture.h"
#include "widgets/base/FlowLayout.h"
#include "widgets/base/Theme.h"
#include "widgets/base/axisWords.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/ColourBar.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    using In = ComparedEvent::In;

    QString nameOf(In in)
    {
        return in == In::A ? QStringLiteral("A") : in == In::B ? QStringLiteral("B") : QObject::tr("both");
    }

    /// Before there are analyses, the headings alone.
    std::vector<TableHeading> comparedHeadings(const ColumnTimes &times, const QString &place,
                                               const QString &unitA = {}, const QString &unitB = {})
    {
        return {{ComparePanel::tr("In"), {}, Qt::AlignLeft},
                {times.heading(ComparePanel::tr("Onset"))},
                {place},
                {times.heading(ComparePanel::tr("A at")), ComparePanel::tr("Time at which A detected it")},
                {times.heading(ComparePanel::tr("B at")), ComparePanel::tr("Time at which B detected it")},
                {ComparePanel::tr("D of A"), ComparePanel::tr("Largest statistic in A, %1").arg(unitA)},
                {ComparePanel::tr("D of B"), ComparePanel::tr("Largest statistic in B, %1").arg(unitB)}};
    }

} // namespace

ComparePanel::ComparePanel(Document &document, AnalysisController &controller, Comparer &comparer, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_comparer(comparer),
      m_picture(new WaterfallView(tr("B − A (nat)"), nullptr, &document.direction())), m_picturePane(buildPicture()),
      m_sentence(panelSentence()), m_differences(plainLabel()), m_keep(new QPushButton(tr("Keep as A"))),
      m_swap(new QPushButton(tr("Swap"))), m_goTo(new QPushButton(tr("Go to A"))),
      m_compute(new QPushButton(tr("Compute A here"))), m_filters{new QToolButton, new QToolButton, new QToolButton},
      m_table(new ColumnTable(tr("Events of A and B")))
{
    buildTable();
    auto *splitter = new QSplitter(Qt::Horizontal);
    splitter->addWidget(m_picturePane);
    splitter->addWidget(buildList());
    splitter->setSizes({500, 560});
    splitter->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(buildWords());
    layout->addWidget(splitter, 1);

    connect(&comparer, &Comparer::changed, this, &ComparePanel::follow);
    connect(&comparer, &Comparer::keptChanged, this, &ComparePanel::follow);
    connect(&comparer, &Comparer::costChanged, this, &ComparePanel::showWords);
    connect(&comparer, &Comparer::progressed, this, [this](double fraction, const QString &what) {
        m_sentence->setText(tr("%1, %2 %").arg(what).arg(int(100.0 * fraction)));
    });
    connect(&comparer, &Comparer::failed, this,
            [this](const Error &error) { m_sentence->setText(messageText(error.what())); });
    connect(&document, &Document::analysisChanged, this, &ComparePanel::updateButtons);
    follow();
}

QWidget *ComparePanel::buildPicture()
{
    m_picture->setObjectName(QStringLiteral("difference"));
    m_picture->setViewport(&m_document.viewport());
    m_picture->display().setColourMap(Theme::kind(palette()) == Theme::Kind::Light ? QStringLiteral("blue-red")
                                                                                   : QStringLiteral("ice-fire"));
    m_picture->setMinimumSize(150, 90);
    return ColourBar::pane(m_picture);
}

QWidget *ComparePanel::buildWords()
{
    m_differences->setWordWrap(true);
    for (QLabel *label : {m_sentence, m_differences})
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_sentence->setAccessibleName(tr("Comparison"));
    m_differences->setAccessibleName(tr("Settings in which A and B differ"));
    auto *words = new QWidget;
    auto *layout = new QVBoxLayout(words);
    layout->setContentsMargins(8, 4, 8, 2);
    layout->setSpacing(2);
    layout->addWidget(m_sentence);
    layout->addWidget(m_differences);
    return words;
}

QWidget *ComparePanel::buildList()
{
    auto *list = new QWidget;
    auto *layout = new QVBoxLayout(list);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(buildButtons());
    layout->addWidget(m_table, 1);
    return list;
}

QWidget *ComparePanel::buildButtons()
{
    auto *row = new QWidget;
    auto *layout = new FlowLayout(row);
    layout->setContentsMargins(8, 2, 8, 4);
    layout->setSpacing(6);
    for (QPushButton *button : {m_keep, m_swap, m_goTo, m_compute})
        layout->addWidget(button);
    m_keep->setToolTip(tr("Keep the current settings and results as A (Ctrl+B)"));
    m_swap->setToolTip(tr("Exchange A and the current settings"));
    m_goTo->setToolTip(tr("Apply A's settings; undo restores the current ones"));
    m_compute->setToolTip(tr("A was computed on another source; compute it on the open one"));
    for (const In in : {In::Both, In::A, In::B}) {
        QToolButton *filter = m_filters[int(in)];
        filter->setCheckable(true);
        filter->setChecked(true);
        filter->setToolTip(in == In::Both ? tr("List the events that both found")
                                          : tr("List the events that only %1 found").arg(nameOf(in)));
        connect(filter, &QToolButton::toggled, this, &ComparePanel::showEvents);
        layout->addWidget(filter);
    }
    connect(m_keep, &QPushButton::clicked, this, &ComparePanel::keep);
    connect(m_swap, &QPushButton::clicked, this, &ComparePanel::swap);
    connect(m_goTo, &QPushButton::clicked, this, &ComparePanel::goToA);
    connect(m_compute, &QPushButton::clicked, &m_comparer, &Comparer::computeHere);
    return row;
}

void ComparePanel::buildTable()
{
    m_table->show(comparedHeadings({0.0, 1.0}, tr("Frequency (Hz)")));
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(1, Qt::AscendingOrder); // onset
    connect(m_table, &ColumnTable::clicked, this, &ComparePanel::goTo);
    connect(m_table, &ColumnTable::activated, this, &ComparePanel::goTo);
}

void ComparePanel::showEvent(QShowEvent *event)
{
    QWidget::showEvent(event);
    m_comparer.setActive(true);
}

void ComparePanel::hideEvent(QHideEvent *event)
{
    QWidget::hideEvent(event);
    m_comparer.setActive(false);
}

void ComparePanel::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        m_picture->display().setColourMap(Theme::kind(palette()) == Theme::Kind::Light ? QStringLiteral("blue-red")
                                                                                       : QStringLiteral("ice-fire"));
}

void ComparePanel::keep()
{
    m_comparer.keep();
}

void ComparePanel::swap()
{
    if (m_comparer.kept())
        m_controller.setSettings(m_comparer.exchange(), tr("Swap A and B"));
}

void ComparePanel::goToA()
{
    if (m_comparer.kept())
        m_controller.setSettings(m_comparer.kept()->settings, tr("Go to A"));
}

void ComparePanel::follow()
{
    showPicture();
    showEvents();
    showWords();
    updateButtons();
}

void ComparePanel::updateButtons()
{
    const bool hasA = m_comparer.kept() != nullptr;
    m_keep->setEnabled(m_document.analysis() != nullptr);
    m_swap->setEnabled(hasA && m_comparer.isOfWhatIsOpen());
    m_goTo->setEnabled(hasA && !m_document.isEmpty());
    m_compute->setVisible(hasA && !m_document.isEmpty() && !m_comparer.isOfWhatIsOpen());
}

void ComparePanel::showPicture()
{
    const auto &result = m_comparer.result();
    m_picturePane->setVisible(m_document.isOnePicture());
    m_picture->setEmptySentence(m_comparer.kept()
                                    ? tr("The difference appears here if A and B are of the same "
                                         "recording.")
                                    : tr("Keep the current result as A (Ctrl+B), then change any setting."));
    if (!result || !result->difference)
        return m_picture->setPicture(nullptr, {});
    const bool isPlain = haveCommonUnit(*result->a, *result->b);
    m_picture->setStatisticUnit(tr("nat"), isPlain ? tr("B − A (nat)") : tr("B − A, rarity (nat)"));
    m_picturePane->setToolTip(isPlain ? tr("Margin of B above its threshold minus that of A. Blue: A is higher; red: B "
                                           "is higher.")
                                      : tr("Margin of B minus that of A, in log false-alarm probability because their "
                                           "statistics differ in unit. Blue: A is higher; red: B is higher."));
    m_picture->setPicture(result->difference, result->b->grid().axes.back());
}

void ComparePanel::showEvents()
{
    const auto &result = m_comparer.result();
    const Comparison none;
    const Comparison &comparison = result ? result->comparison : none;
    for (const In in : {In::A, In::B, In::Both})
        m_filters[int(in)]->setText(in == In::Both ? tr("both %1").arg(comparison.count(in))
                                                   : tr("%1 %2").arg(nameOf(in)).arg(comparison.count(in)));
    m_listed.clear();
    m_table->clear();
    if (!result)
        return;
    const Axis &place = result->b->grid().axes.back();
    const FrequencyUnit unit = shownUnit(place);
    const int decimals = place.unit == "Hz" ? decimalsFor(place.step / unit.hz) : 1;
    const ColumnTimes times(result->b->time().last(), result->b->time().step);
    const auto time = [&times](const std::optional<Event> &side) {
        return side ? TableCell{times.text(side->detectSeconds), side->detectSeconds} : TableCell{};
    };
    const auto nats = [](const std::optional<Event> &side) {
        return side ? TableCell{numberText(side->statistic, 1), side->statistic} : TableCell{};
    };
    std::vector<std::vector<TableCell>> rows;
    for (const ComparedEvent &compared : comparison.events) {
        if (!m_filters[int(compared.in())]->isChecked())
            continue;
        const Event &event = compared.event();
        const double at = event.position.back();
        rows.push_back({{nameOf(compared.in()), double(compared.in())},
                        {times.text(event.onsetSeconds), event.onsetSeconds},
                        {numberText(at / unit.hz, decimals), at},
                        time(compared.a),
                        time(compared.b),
                        nats(compared.a),
                        nats(compared.b)});
        m_listed.push_back(&compared);
    }
    m_table->show(
        comparedHeadings(times, titleOf(place), statisticUnit(result->a->settings), statisticUnit(result->b->settings)),
        std::move(rows));
    m_picture->setTracks(tracksAlone(*result), result->b->time());
}

/// What one of the two has missed: that is what one looks for. A's only where both lie on the same axes.
std::vector<Track> ComparePanel::tracksAlone(const Comparer::Result &result) const
{
    const bool haveSameAxes = result.a->time() == result.b->time() && result.a->grid() == result.b->grid();
    std::vector<Track> alone;
    for (const ComparedEvent &compared : result.comparison.events) {
        if (compared.in() == In::Both || !m_filters[int(compared.in())]->isChecked() || (!compared.b && !haveSameAxes))
            continue;
        if (const Track *track = trackOfId((compared.b ? result.b : result.a)->tracks, compared.event().id))
            alone.push_back(*track);
    }
    return alone;
}

QString ComparePanel::costText() const
{
    const auto &cost = m_comparer.cost();
    if (!cost)
        return {};
    const auto seconds = [](double value) { return numberText(value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0); };
    return tr(" One hour of recording takes %1 s of processor time with A and %2 s with B.")
        .arg(seconds(cost->a), seconds(cost->b));
}

void ComparePanel::showWords()
{
    const auto &result = m_comparer.result();
    if (!result) {
        m_differences->clear();
        if (!m_comparer.kept())
            m_sentence->setText(tr("Keep the current result as A, then change the detector or any setting. The "
                                   "difference, and the events that only one of the two found, appear here."));
        else
            m_sentence->setText(m_comparer.isOfWhatIsOpen() ? tr("Comparing …")
                                                            : tr("A was computed on another source."));
        return;
    }
    const Comparison &comparison = result->comparison;
    m_sentence->setText(tr("A finds %1, B %2: %3 in both, %4 only in A, %5 only in B.")
                            .arg(result->a->tracks.size())
                            .arg(result->b->tracks.size())
                            .arg(comparison.count(In::Both))
                            .arg(comparison.count(In::A))
                            .arg(comparison.count(In::B))
                        + costText());
    QStringList words;
    for (const SettingDifference &difference : result->settings)
        words << differenceWords(difference);
    m_differences->setText(words.isEmpty() ? tr("A and B have the same settings. Change a setting to see its effect "
                                                "here.")
                                           : tr("From A to B: %1.").arg(words.join(QStringLiteral("; "))));
}

void ComparePanel::goTo(const QModelIndex &index)
{
    const auto &result = m_comparer.result();
    if (!result || !index.isValid())
        return;
    const ComparedEvent &compared = *m_listed[std::size_t(m_table->sourceRow(index))];
    if (compared.b)
        return emit eventActivated(compared.b->id);
    const Track *track = trackOfId(result->a->tracks, compared.a->id);
    if (!track || track->points.empty() || !m_document.lineAnalysis())
        return;
    m_document.viewport().reveal(trackBox(*track, *result->a));
    m_document.viewport().setCursor({compared.a->detectSeconds, compared.a->detectedPosition.back()});
}

} // namespace faintline
