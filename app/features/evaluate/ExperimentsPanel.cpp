#include "app/features/evaluate/ExperimentsPanel.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/document/Provenance.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "exchange/CampaignFile.h"
#include "reproduce/writeReproduction.h"
#include "widgets/base/labelText.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

namespace faintline {

namespace {

    enum ExperimentColumn { Name, Progress, State, ExperimentColumns };

    QString stateText(const Experiments::Entry &entry)
    {
        switch (entry.state) {
        case Experiments::State::Waiting:
            return QObject::tr("waiting");
        case Experiments::State::Running:
            return QObject::tr("running");
        case Experiments::State::Done:
            return entry.reproduction
                       ? (entry.reproduction->isInside() ? QObject::tr("done, inside") : QObject::tr("done, outside"))
                       : QObject::tr("done");
        case Experiments::State::Cancelled:
            return QObject::tr("cancelled");
        case Experiments::State::Failed:
            return QObject::tr("failed");
        }
        return {};
    }

} // namespace

ExperimentsPanel::ExperimentsPanel(Experiments &experiments, QWidget *parent)
    : Panel(parent), m_experiments(experiments), m_table(new QTableWidget(0, ExperimentColumns)),
      m_show(new QPushButton(tr("Show"))), m_cancel(new QPushButton(tr("Cancel"))),
      m_remove(new QPushButton(tr("Remove"))), m_export(new QPushButton(tr("Export…")))
{
    auto *import = new QPushButton(tr("Import…"));
    import->setToolTip(tr("Import the runs of a campaign or shard, or a curve in CSV"));
    m_show->setToolTip(tr("Show the curves or tables of the experiment (Enter)"));
    m_export->setToolTip(tr("Export a curve as CSV, runs as a campaign, or a reproduction as tables and pictures"));
    m_table->setHorizontalHeaderLabels({tr("Experiment"), tr("Progress"), tr("State")});
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setDefaultSectionSize(24);
    m_table->horizontalHeader()->setSectionResizeMode(Name, QHeaderView::Stretch);
    m_table->horizontalHeader()->setSectionResizeMode(Progress, QHeaderView::Fixed);
    m_table->horizontalHeader()->setHighlightSections(false);
    m_table->setColumnWidth(Progress, 110);
    m_table->setColumnWidth(State, 110);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setShowGrid(false);
    m_table->setFrameShape(QFrame::NoFrame);
    m_table->setAccessibleName(tr("Experiments"));
    auto *buttons = new QVBoxLayout;
    buttons->setContentsMargins(6, 6, 8, 6);
    buttons->setSpacing(4);
    for (QPushButton *button : {m_show, m_cancel, m_remove, m_export, import})
        buttons->addWidget(button);
    buttons->addStretch(1);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_table, 1);
    layout->addLayout(buttons);

    connect(&experiments, &Experiments::added, this, &ExperimentsPanel::add);
    connect(&experiments, &Experiments::changed, this, &ExperimentsPanel::follow);
    connect(&experiments, &Experiments::removed, this, [this](int id) {
        for (int row = 0; row < m_table->rowCount(); ++row)
            if (m_table->item(row, Name)->data(Qt::UserRole).toInt() == id)
                return m_table->removeRow(row);
    });
    connect(m_table, &QTableWidget::itemSelectionChanged, this, &ExperimentsPanel::followSelection);
    connect(m_table, &QTableWidget::activated, this, [this] { emit showRequested(selected()); });
    connect(m_show, &QPushButton::clicked, this, [this] { emit showRequested(selected()); });
    connect(m_cancel, &QPushButton::clicked, this, [this] { m_experiments.cancel(selected()); });
    connect(m_remove, &QPushButton::clicked, this, [this] { m_experiments.remove(selected()); });
    connect(m_export, &QPushButton::clicked, this, &ExperimentsPanel::chooseExport);
    connect(import, &QPushButton::clicked, this, &ExperimentsPanel::chooseImport);
    followSelection();
}

int ExperimentsPanel::selected() const
{
    const QList<QTableWidgetItem *> items = m_table->selectedItems();
    return items.isEmpty() ? 0 : m_table->item(items.first()->row(), Name)->data(Qt::UserRole).toInt();
}

void ExperimentsPanel::add(int id)
{
    const int row = m_table->rowCount();
    m_table->insertRow(row);
    auto *name = new QTableWidgetItem(m_experiments.entry(id)->name);
    name->setData(Qt::UserRole, id);
    name->setToolTip(asHtml(name->text()));
    m_table->setItem(row, Name, name);
    m_table->setItem(row, State, new QTableWidgetItem);
    auto *bar = new QProgressBar;
    bar->setRange(0, 100);
    bar->setAccessibleName(tr("Progress of %1").arg(name->text()));
    m_table->setCellWidget(row, Progress, bar);
    m_table->selectRow(row);
    follow(id);
}

void ExperimentsPanel::follow(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    for (int row = 0; entry && row < m_table->rowCount(); ++row) {
        if (m_table->item(row, Name)->data(Qt::UserRole).toInt() != id)
            continue;
        static_cast<QProgressBar *>(m_table->cellWidget(row, Progress))->setValue(int(100.0 * entry->progress));
        m_table->item(row, State)->setText(stateText(*entry));
        m_table->item(row, State)->setToolTip(entry->failure.isEmpty() ? QString() : asHtml(entry->failure));
    }
    followSelection();
}

void ExperimentsPanel::followSelection()
{
    const Experiments::Entry *entry = m_experiments.entry(selected());
    m_show->setEnabled(entry && (entry->campaign || entry->imported || entry->reproduction));
    m_cancel->setEnabled(entry && entry->isOpen());
    m_remove->setEnabled(entry);
    m_export->setEnabled(entry && !entry->isOpen() && (entry->runsDone() > 0 || entry->reproduction));
}

bool ExperimentsPanel::isExperiment(const QString &path)
{
    const std::string file = pathBytes(path);
    try {
        if (hasEnding(file, ".jsonl"))
            return isCampaignFile(file);
        if (hasEnding(file, ".csv"))
            return isCurveFile(file);
        if (!hasEnding(file, ".json"))
            return false;
        const Json json = readJsonFile(file);
        return json.is_object() && (json.contains("detectors") || json.contains("parameter"));
    } catch (const Error &) {
        return false; // reported when it is opened
    }
}

int ExperimentsPanel::open(const QString &path)
{
    constexpr qint64 largestExperiment = 64 << 20;
    const std::string file = pathBytes(path);
    try {
        const auto start = [&] {
            const Json json = parseJson(readBeginning(path, largestExperiment).toStdString(), file);
            return m_experiments.start(fileLabel(path), experimentFromJson(json, file));
        };
        const int id = hasEnding(file, ".json") ? start() : importFile(path);
        emit showRequested(id);
        return id;
    } catch (const Error &error) {
        emit failed(error);
        return 0;
    }
}

int ExperimentsPanel::importFile(const QString &path)
{
    const std::string file = pathBytes(path);
    const QString name = fileLabel(path);
    return isCampaignFile(file) ? m_experiments.add(name, readCampaign(file))
                                : m_experiments.add(name, readCurve(file));
}

/// Saves the curve together with the experiment from which `evaluate` can reproduce it.
static void writeWithOrigin(const Campaign &campaign, const QString &path)
{
    writeCurve(campaign, pathBytes(path));
    Json json = {{"version", FAINTLINE_VERSION}, {"experiment", toJson(campaign.experiment)}};
    if (std::ssize(campaign.outcomes) < campaign.experiment.runs()) // it was stopped
        for (const RunOutcome &outcome : campaign.outcomes)
            json["runs"].push_back(outcome.run);
    writeProvenanceBeside(path, json.dump(2) + "\n");
}

void ExperimentsPanel::exportTo(int id, const QString &path) const
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (!entry)
        return;
    if (entry->reproduction)
        return writeReproduction(*entry->reproduction, pathBytes(path));
    const std::string name = pathBytes(path);
    checkEnding(name, {".csv", ".jsonl"});
    hasEnding(name, ".csv") ? writeWithOrigin(*entry->campaign, path) : writeCampaign(*entry->campaign, name);
}

void ExperimentsPanel::chooseImport()
{
    const QString path = QFileDialog::getOpenFileName(this, tr("Import a campaign or a curve"));
    if (!path.isEmpty())
        actOrReport(*this, [&] { emit showRequested(importFile(path)); });
}

void ExperimentsPanel::chooseExport()
{
    const Experiments::Entry *entry = m_experiments.entry(selected());
    const QString path = entry->reproduction
                             ? QFileDialog::getExistingDirectory(this, tr("Folder for tables and pictures"))
                             : QFileDialog::getSaveFileName(this, tr("Export"), QStringLiteral("curve.csv"),
                                                            tr("Curve (*.csv);;Runs of the campaign (*.jsonl)"));
    if (!path.isEmpty())
        actOrReport(*this, [&] { exportTo(entry->id, path); });
}

} // namespace faintline
