#include "app/panels/OpenOptionsDialog.h"

#include "app/base/filePath.h"
#include "signal/formats/RawRecording.h"
#include "signal/formats/SampleType.h"
#include "signal/openFields.h"
#include "signal/openRecording.h"
#include "widgets/base/labelText.h"

#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace faintline {

namespace {

    /// Type and rate as a receiver's program wrote them into the name, else the type of the extension.
    OpenOptions suggested(const QString &path)
    {
        OpenOptions options = withNamedFormat(pathBytes(path), {});
        if (options.rawType.empty())
            options.rawType = rawTypeOfExtension(pathBytes(path)).value_or("");
        if (options.rawType.empty())
            options.rawType = "ci16_le";
        if (!(options.rawRateHz > 0.0))
            options.rawRateHz = 48000.0;
        return options;
    }

} // namespace

OpenOptionsDialog::OpenOptionsDialog(const QString &path, QWidget *parent)
    : QDialog(parent), m_fileBytes(fileSize(path)),
      m_form(new FieldForm<OpenOptions>(tr("Format"), openFields(), suggested(path))), m_length(plainLabel()),
      m_buttons(new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel))
{
    setWindowTitle(tr("Raw samples"));
    connect(m_buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(new QLabel(
        tr("<b>%1</b> holds samples without a header. Specify their format.").arg(fileLabel(path).toHtmlEscaped())));
    layout->addWidget(m_form);
    layout->addWidget(m_length);
    layout->addWidget(m_buttons);
    connect(m_form, &FieldFormBase::edited, this, &OpenOptionsDialog::showLength);
    showLength();
}

void OpenOptionsDialog::showLength()
{
    const SampleType type = parseSampleType(options().rawType, "type");
    const auto samples =
        double((m_fileBytes - options().rawHeaderBytes) / (type.sampleBytes() * options().rawChannels));
    m_length->setText(tr("Length %1 s").arg(std::max(0.0, samples) / options().rawRateHz, 0, 'g', 6));
    m_form->editor(QStringLiteral("iq"))->setEnabled(!type.isComplex && options().rawChannels % 2 == 0);
    m_buttons->button(QDialogButtonBox::Open)->setEnabled(!m_form->isRefused());
}

} // namespace faintline
