#include "app/features/survey/SurveyPanel.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "exchange/survey/SurveyDatabase.h"
#include "widgets/base/labelText.h"
#include "widgets/table/ColumnTable.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace faintline {

SurveyPanel::SurveyPanel(const Document &document, const AnalysisController &controller, QWidget *parent)
    : Panel(parent), m_document(document), m_model(new SurveyModel(this)),
      m_table(new ColumnTable(tr("Events of the survey"), m_model)), m_summary(plainLabel())
{
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(SurveyModel::Statistic, Qt::DescendingOrder);
    m_table->setSmall();
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_table->setColumnWidth(SurveyModel::Recording, 220);
    m_table->setTextElideMode(Qt::ElideMiddle); // a path ends with the file's name
    m_table->installEventFilter(this);

    auto *bottom = new QHBoxLayout;
    bottom->setContentsMargins(8, 4, 8, 4);
    m_summary->setWordWrap(true);
    bottom->addWidget(m_summary, 1);
    addVerdict(*bottom, tr("Accept"), tr("Accept the selected events, in the survey's file (Y)"), Qt::Key_Y,
               Verdict::Accepted);
    addVerdict(*bottom, tr("Reject"), tr("Reject the selected events, in the survey's file (X)"), Qt::Key_X,
               Verdict::Rejected);
    addVerdict(*bottom, tr("Clear"), tr("Remove the review of the selected events (U)"), Qt::Key_U, Verdict::None);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_table, 1);
    layout->addLayout(bottom);
    m_summary->setText(tr("Open a survey (.sqlite) with File > Open. The command faintline-cli survey creates one."));

    connect(&m_runner, &JobRunner::failed, this, &SurveyPanel::failed);
    connect(&controller, &AnalysisController::settled, this, &SurveyPanel::reach);
    connect(m_table, &ColumnTable::activated, this, &SurveyPanel::activate);
    connect(m_table->selectionModel(), &QItemSelectionModel::selectionChanged, this, &SurveyPanel::followSelection);
    followSelection();
}

void SurveyPanel::addVerdict(QBoxLayout &layout, const QString &text, const QString &tip, Qt::Key key, Verdict verdict)
{
    auto *button = new QPushButton(text);
    button->setToolTip(tip);
    layout.addWidget(button);
    m_buttons.append(button);
    connect(button, &QPushButton::clicked, this, [this, verdict] { judge(verdict); });
    m_keys.insert(key, verdict);
}

/// In this table, the review keys apply to the survey's events, not to those of the open recording.
bool SurveyPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress)
        return QWidget::eventFilter(watched, event);
    const auto *pressed = static_cast<QKeyEvent *>(event);
    const auto verdict = m_keys.constFind(pressed->key());
    const bool isClass = (pressed->key() >= Qt::Key_1 && pressed->key() <= Qt::Key_9)
                         || (pressed->key() == Qt::Key_U && pressed->modifiers() == Qt::ShiftModifier);
    if (isClass) { // not stored in a survey
        event->accept();
        return true;
    }
    if (verdict == m_keys.constEnd() || pressed->modifiers() != Qt::NoModifier)
        return QWidget::eventFilter(watched, event);
    if (event->type() == QEvent::KeyPress)
        judge(*verdict);
    event->accept();
    return true;
}

bool SurveyPanel::isSurvey(const QString &path)
{
    if (path.endsWith(QLatin1String(".sqlite"), Qt::CaseInsensitive))
        return true;
    if (!isRegularFile(path))
        return false;
    try {
        const QByteArray beginning = readBeginning(path, surveyHeaderBytes);
        return isSurveyHeader(std::as_bytes(std::span(beginning.constData(), std::size_t(beginning.size()))));
    } catch (const Error &) { // what opens it says why
        return false;
    }
}

void SurveyPanel::open(const QString &path)
{
    m_runner.start([this, path](const RunContext &context) -> JobRunner::Delivery {
        try {
            const auto content = std::make_shared<SurveyModel::Content>(SurveyModel::read(path, context));
            return [this, content] { show(std::move(*content)); };
        } catch (const std::bad_alloc &) {
            throw Error(pathBytes(path), "out of memory", Error::Kind::Failure);
        }
    });
}

void SurveyPanel::show(SurveyModel::Content content)
{
    m_model->show(std::move(content));
    const auto &recordings = m_model->recordings();
    const auto failed = std::count_if(recordings.begin(), recordings.end(),
                                      [](const SurveyRecording &one) { return !one.isAnalysed(); });
    QString summary = tr("%1: %2 events in %3 recordings")
                          .arg(fileLabel(m_model->path()))
                          .arg(m_model->rowCount())
                          .arg(qlonglong(recordings.size()));
    if (failed > 0)
        summary += tr(", %1 could not be analysed").arg(qlonglong(failed));
    m_summary->setText(summary);
    followSelection(); // gone with the former content, without a signal
    emit opened();
}

void SurveyPanel::followSelection()
{
    for (QPushButton *button : m_buttons)
        button->setEnabled(m_table->selectionModel()->hasSelection());
}

void SurveyPanel::judge(Verdict verdict)
{
    actOrReport(*this, [&] { m_model->judge(m_table->selectedSourceRows(), verdict); });
}

void SurveyPanel::activate(const QModelIndex &index)
{
    const SurveyModel::Row &row = m_model->row(m_table->sourceRow(index));
    const QString path = pathText(m_model->recordings()[row.recording].file.path);
    const int event = row.event.event.id;
    const SurveySettings &settings = m_model->settings();
    if (absolutePath(m_document.sourcePath()) == path && m_document.settings() == settings.analysis
        && m_document.analysis())
        return emit eventReached(event);
    m_wanted = {path, event};
    emit openRequested(path, settings.open,
                       [analysis = settings.analysis](AnalysisSettings &opened) { opened = analysis; });
}

void SurveyPanel::reach()
{
    const auto wanted = std::exchange(m_wanted, {}); // also where the recording could not be opened
    if (wanted.event != 0 && m_document.analysis() && absolutePath(m_document.sourcePath()) == wanted.path)
        emit eventReached(wanted.event);
}

} // namespace faintline
