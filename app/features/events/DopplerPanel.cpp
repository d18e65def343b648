#include "app/features/events/DopplerPanel.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/document/Document.h"
#include "app/document/Provenance.h"
#include "app/document/thresholdWords.h"
#include "app/features/events/chosenEvents.h"
#include "base/json.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>

#include <cmath>
#include <utility>

namespace faintline {

namespace {

    struct Medium {
        const char *name;
        double metresPerSecond;
    };
    constexpr Medium media[]{{QT_TRANSLATE_NOOP("faintline::DopplerPanel", "Air"), propagation::air},
                             {QT_TRANSLATE_NOOP("faintline::DopplerPanel", "Water"), propagation::water},
                             {QT_TRANSLATE_NOOP("faintline::DopplerPanel", "Light, radio"), propagation::light}};

    QString text(const std::string &words)
    {
        return QString::fromStdString(words).replace(QLatin1Char('-'), QChar(0x2212));
    }

    QString sentenceOf(const DopplerReport &report)
    {
        const std::vector<DopplerPoint> &points = report.track.points;
        const DopplerFit &fit = report.fit;
        return (report.events.size() == 1 ? DopplerPanel::tr("Event %1") : DopplerPanel::tr("Events %1"))
                   .arg(QString::fromStdString(eventNumbers(report)))
               + DopplerPanel::tr(": %1 … %2, %3 points. Residuals: rms %4 Hz, %5 times the track's own errors.")
                     .arg(secondsText(points.front().seconds, 0.1), secondsText(points.back().seconds, 0.1))
                     .arg(points.size())
                     .arg(powerText(fit.rmsHz, 3), powerText(fit.deviationScale, 2));
    }

} // namespace

DopplerPanel::DopplerPanel(Document &document, const EventTable &events, Provenance &provenance, QWidget *parent)
    : Panel(parent), m_document(document), m_events(events), m_provenance(provenance), m_form(new QFormLayout),
      m_medium(new QComboBox), m_propagation(new QDoubleSpinBox), m_centre(new QDoubleSpinBox),
      m_save(new QPushButton(tr("&Save fit…"))), m_sentence(panelSentence()),
      m_table(new ColumnTable(tr("The pass and its 90 % intervals"))), m_notes(plainLabel()),
      m_frequencies(new ChartPlot), m_residuals(new ChartPlot),
      m_fit(
          this, &DopplerPanel::question,
          [](const auto &analysis, const auto &chosen, double centreHz, double propagation, const RunContext &) {
              return dopplerReport(*analysis, *chosen, centreHz, propagation);
          },
          &DopplerPanel::show)
{
    buildInputs();
    m_notes->setWordWrap(true);
    for (QLabel *label : {m_sentence, m_notes})
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_table->setSmall(20);
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_table->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    m_table->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_frequencies->setEmptySentence(tr("The track and the fitted pass appear here."));
    m_residuals->setEmptySentence(tr("The residuals appear here."));

    auto *words = new QWidget;
    auto *column = new QVBoxLayout(words);
    column->setContentsMargins(8, 6, 8, 6);
    column->addLayout(m_form);
    column->addWidget(m_sentence);
    column->addWidget(m_table);
    column->addWidget(m_notes);
    column->addWidget(m_save, 0, Qt::AlignLeft);
    column->addStretch(1);
    QScrollArea *scroll = scrolledColumn(words, Qt::ScrollBarAsNeeded);
    scroll->setAccessibleName(tr("Doppler fit"));
    auto *charts = new QSplitter(Qt::Vertical);
    charts->addWidget(m_frequencies);
    charts->addWidget(m_residuals);
    charts->setSizes({3, 2});
    auto *sides = new QSplitter(Qt::Horizontal);
    sides->addWidget(scroll);
    sides->addWidget(charts);
    sides->setSizes({380, 520});
    for (QSplitter *splitter : {charts, sides})
        splitter->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(sides);
    connectInputs();
    takeCentre();
    m_fit.ask();
}

void DopplerPanel::buildInputs()
{
    for (const Medium &medium : media)
        m_medium->addItem(tr(medium.name), medium.metresPerSecond);
    m_medium->addItem(tr("Other"));
    m_propagation->setRange(1e-3, 1e12);
    m_propagation->setDecimals(3);
    m_propagation->setSuffix(tr(" m/s"));
    m_centre->setRange(0.0, 1e15);
    m_centre->setDecimals(3);
    m_centre->setSuffix(tr(" Hz"));
    m_centre->setToolTip(tr("Radio frequency at 0 Hz of the I/Q recording; the fit needs absolute frequencies"));
    for (QDoubleSpinBox *box : {m_propagation, m_centre})
        box->setKeyboardTracking(false);
    m_form->addRow(tr("&Medium"), m_medium);
    m_form->addRow(tr("S&peed of propagation"), m_propagation);
    m_form->addRow(tr("&Centre frequency"), m_centre);
    takeMedium();
}

void DopplerPanel::connectInputs()
{
    connect(m_medium, &QComboBox::activated, this, &DopplerPanel::takeMedium);
    connect(m_propagation, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        const int known = m_medium->findData(value);
        m_medium->setCurrentIndex(known >= 0 ? known : m_medium->count() - 1);
        m_fit.ask();
    });
    connect(m_save, &QPushButton::clicked, this, &DopplerPanel::ask);
    connect(&m_document, &Document::opened, this, [this] { // its centre frequency is not that of the previous source
        const QSignalBlocker quiet(m_centre);
        m_centre->setValue(0.0);
        m_isCentreKnown = false;
    });
    connect(&m_document, &Document::analysisChanged, this, &DopplerPanel::takeCentre);
    connect(&m_fit, &JobRunner::busyChanged, this, [this](bool isBusy) {
        m_save->setEnabled(!isBusy && m_fit.answer()); // the result belongs to the selection
        if (isBusy && !m_fit.answer())
            m_sentence->setText(tr("Fitting …"));
    });
    m_fit.watch(*this, m_sentence);
    m_fit.askAt(*m_centre, &QDoubleSpinBox::valueChanged);
    m_fit.askAt(m_events, &EventTable::selectionChanged);
    m_fit.askAt(m_document, &Document::opened, &Document::shownEventsChanged);
}

void DopplerPanel::takeMedium()
{
    if (const QVariant speed = m_medium->currentData(); speed.isValid())
        m_propagation->setValue(speed.toDouble());
}

/// Shows the field for the centre frequency if needed, with the recording's value; a value typed since is kept.
void DopplerPanel::takeCentre()
{
    const auto analysis = m_document.lineAnalysis();
    const std::optional<double> known = analysis ? centreOfFrames(*analysis) : 0.0;
    m_form->setRowVisible(m_centre, !known || *known != 0.0);
    if (!analysis || !known || std::exchange(m_isCentreKnown, true))
        return;
    const QSignalBlocker quiet(m_centre);
    m_centre->setValue(*known);
}

DopplerPanel::Asking::Question DopplerPanel::question() const
{
    const auto analysis = m_document.lineAnalysis();
    if (!analysis)
        return m_document.analysis() ? tr("A Doppler fit needs frames on frequency.")
                                     : tr("Select an event to fit the pass of a source to its track.");
    const auto chosen = std::make_shared<const std::vector<Event>>(chosenEvents(m_document, m_events));
    if (chosen->empty())
        return tr("There is no event at this threshold.");
    const double centreHz = m_centre->isHidden() ? 0.0 : m_centre->value();
    if (!m_centre->isHidden() && centreHz == 0.0)
        return tr("The recording is I/Q and does not say its centre frequency; enter it, as the fit needs absolute "
                  "frequencies.");
    return std::tuple(analysis, chosen, centreHz, m_propagation->value());
}

void DopplerPanel::show()
{
    m_table->setVisible(m_fit.answer());
    m_save->setEnabled(m_fit.answer());
    if (!m_fit.answer()) {
        m_notes->clear();
        m_table->clear();
        m_frequencies->setChart({});
        return m_residuals->setChart({});
    }
    const DopplerReport &report = *m_fit.answer();
    m_sentence->setText(sentenceOf(report));
    std::vector<std::vector<TableCell>> rows;
    for (const DopplerRow &one : dopplerRows(report.fit))
        rows.push_back({{capitalised(QString::fromStdString(one.name))},
                        {text(valueText(one.value, one.bounds)), one.value},
                        {text(boundsText(one.bounds)), one.bounds.low.value_or(std::nan(""))},
                        {QString::fromStdString(one.unit)}});
    const double heard = report.fit.heardSeconds(), slope = report.fit.slopeHzPerSecond();
    rows.push_back({{tr("Arrival of f₀")}, {text(valueText(heard, report.fit.closestSeconds)), heard}, {}, {tr("s")}});
    rows.push_back({{tr("Slope at f₀")}, {powerText(slope, 4), slope}, {}, {tr("Hz/s")}});
    m_table->show({{tr("Parameter"), {}, Qt::AlignLeft}, {tr("Estimate")}, {tr("90 % interval")}, {tr("Unit")}},
                  std::move(rows));
    m_table->updateGeometry();
    QStringList notes;
    for (const std::string &note : dopplerNotes(report))
        notes << QString::fromStdString(note);
    m_notes->setText(notes.join(QLatin1Char('\n')));
    std::vector<Chart> charts = dopplerCharts(report);
    charts[0].curves.back().kind = Curve::Kind::Measured; // over the points, in its own colour
    m_frequencies->setChart(charts[0]);
    m_residuals->setChart(charts[1]);
}

void DopplerPanel::ask()
{
    const QString path = QFileDialog::getSaveFileName(
        this, tr("Save fit"), nameBeside(m_document.sourcePath(), QStringLiteral("-doppler.json")),
        tr("Fit (*.json);;Points and residuals (*.csv)"));
    if (!path.isEmpty())
        saveTo(path);
}

void DopplerPanel::saveTo(const QString &path)
{
    if (!m_fit.answer())
        return;
    if (const auto analysis = m_document.lineAnalysis(); !analysis || analysis->calibration->isFirstEstimate)
        return emit failed(firstEstimateError());
    m_provenance.with([this, path, report = *m_fit.answer()](const std::string &provenance) {
        writeAndReport(*this, path, [&] {
            writeDoppler(report, pathBytes(path));
            Json json = parseJson(provenance, "provenance");
            json["doppler"] = {
                {"events", Json::array()}, {"centreHz", report.centreHz}, {"propagation", report.fit.propagation}};
            for (const Event &event : report.events)
                json["doppler"]["events"].push_back(event.id);
            writeProvenanceBeside(path, json.dump(2) + "\n");
        });
    });
}

} // namespace faintline
